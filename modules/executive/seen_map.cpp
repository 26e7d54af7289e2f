// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/seen_map.hpp"

#include <algorithm>

namespace waitpoint::executive {

SeenMap::SeenMap(const OccupancyGrid& map, double range_m_max) : map_(map), range_m_max_(range_m_max) { forget(); }

void SeenMap::forget() {
  cells_ = {map_.width(), map_.height(), {}};
  scans_ = 0;
  ever_occupied_.clear();
}

void SeenMap::add(const Pose& device, const posters::LaserReading& scan) {
  ++scans_;
  mark_echoes(device, scan);
  CellIndex last = {-1, -1};
  const double short_m = map_.resolution_m();
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double range = static_cast<double>(scan.range_m[i]);
    const bool is_echo = range < scan.range_max_m && range < range_m_max_;
    const auto [s, c] = exact::sincos(scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(i));
    const double end_m = std::min(range, range_m_max_);
    const Point end = transform(device, {end_m * c, end_m * s});
    const std::optional<CellIndex> cell = map_.cell_at(end);
    if (cell && *cell == last) continue;  // the beam before has passed the same cells
    last = cell.value_or(CellIndex{-1, -1});
    clear_beam(device.position(), end, is_echo ? short_m : 0);
  }
  raise_echoes();
}

void SeenMap::mark_echoes(const Pose& device, const posters::LaserReading& scan) {
  echoes_.clear();
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double range = static_cast<double>(scan.range_m[i]);
    if (range >= scan.range_max_m || range >= range_m_max_) continue;
    const auto [s, c] = exact::sincos(scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(i));
    const std::optional<CellIndex> cell = map_.cell_at(transform(device, {range * c, range * s}));
    if (!cell) continue;
    Seen& seen = cells_(cell->x, cell->y);
    if (seen.echo_of == scans_) continue;
    seen.echo_of = scans_;
    echoes_.push_back(*cell);
  }
}

// In steps of half a cell: a cell that the beam only grazes may be passed over.
void SeenMap::clear_beam(Point from, Point end, double short_m) {
  const Point way = end - from;
  const double length_m = length(way) - short_m, step_m = 0.5 * map_.resolution_m();
  if (length_m <= 0) return;
  const Pose into = between(map_.origin(), {from.x, from.y, 0});
  const auto [s, c] = exact::sincos(-map_.origin().heading);
  const double per_m = 1 / (length(way) * map_.resolution_m());
  const Point along = {(c * way.x - s * way.y) * per_m, (s * way.x + c * way.y) * per_m};  // in cells, of a metre
  const Point start = (1 / map_.resolution_m()) * into.position();
  const int steps = static_cast<int>(length_m / step_m);
  CellIndex last = {-1, -1};
  for (int k = 0; k <= steps; ++k) {
    const Point p = start + (step_m * k) * along;
    if (p.x < 0 || p.y < 0) continue;
    const CellIndex cell = {static_cast<int>(p.x), static_cast<int>(p.y)};
    if (cell == last || !map_.contains(cell)) continue;
    last = cell;
    Seen& seen = cells_(cell.x, cell.y);
    if (seen.echo_of == scans_) continue;
    seen.evidence =
        seen.evidence == unseen ? miss : std::max<Evidence>(least, static_cast<Evidence>(seen.evidence + miss));
  }
}

void SeenMap::raise_echoes() {
  for (const CellIndex cell : echoes_) {
    Seen& seen = cells_(cell.x, cell.y);
    seen.evidence =
        seen.evidence == unseen ? hit : std::min<Evidence>(most, static_cast<Evidence>(seen.evidence + hit));
    if (seen.evidence < occupied_from) continue;
    if (!seen.is_listed) ever_occupied_.push_back(cell);
    seen.is_listed = true;
  }
}

}  // namespace waitpoint::executive
