// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/via_points.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::executive {
namespace {

constexpr std::size_t no_cell = static_cast<std::size_t>(-1);
constexpr std::size_t blind_cells_max = 20;  // a line may be blocked by a corner and clear again beyond it

double distance_cells(CellIndex a, CellIndex b) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  return std::sqrt(dx * dx + dy * dy);
}

// Indices into the path, ascending: its ends, and the approaches to narrow passages.
void find_anchors(const FreeSpace& space, const std::vector<CellIndex>& path, std::vector<std::size_t>& anchors) {
  const PlanningParameters& p = space.parameters();
  const std::uint16_t narrow = space.square_of(p.robot_radius_m + p.narrow_m);
  const auto approach = static_cast<std::size_t>(std::ceil(p.approach_m / space.map().resolution_m()));
  anchors = {0};
  std::size_t last_narrow = no_cell;
  const auto leave_passage = [&] {
    if (last_narrow != no_cell) anchors.push_back(std::min(last_narrow + approach, path.size() - 1));
    last_narrow = no_cell;
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (space.clearance_square(path[i]) >= narrow) continue;
    // Passages closer together than two approaches count as one.
    if (last_narrow != no_cell && i - last_narrow > 2 * approach) leave_passage();
    if (last_narrow == no_cell && i > approach) anchors.push_back(i - approach);
    last_narrow = i;
  }
  leave_passage();
  anchors.push_back(path.size() - 1);
  anchors.erase(std::unique(anchors.begin(), anchors.end()), anchors.end());
}

// The greatest index up to `end` that a straight leg from `begin` can reach.
std::size_t farthest_leg(const FreeSpace& space, const std::vector<CellIndex>& path, std::size_t begin,
                         std::size_t end) {
  const PlanningParameters& p = space.parameters();
  const std::uint16_t full = space.square_of(p.robot_radius_m + p.clearance_m);
  std::uint16_t least = space.square_of(p.robot_radius_m + p.preferred_clearance_m);
  std::size_t farthest = begin + 1;
  for (std::size_t i = begin; i <= end && i <= farthest + blind_cells_max; ++i) {
    least = std::min(least, space.clearance_square(path[i]));
    if (i > farthest && space.clear_line(path[begin], path[i], std::max(full, least))) farthest = i;
  }
  // Collinear cells are a straight leg at any clearance.
  std::size_t run = begin + 1;
  const auto step = [&](std::size_t i) { return CellIndex{path[i + 1].x - path[i].x, path[i + 1].y - path[i].y}; };
  while (run < end && step(run) == step(begin)) ++run;
  return std::max(farthest, run);
}

void add_leg(CellIndex from, CellIndex to, double cells_max, std::vector<CellIndex>& via) {
  const auto parts = static_cast<std::int32_t>(std::ceil(distance_cells(from, to) / cells_max));
  for (std::int32_t k = 1; k < parts; ++k) {
    const auto part = [&](std::int32_t a, std::int32_t b) {
      return a + static_cast<std::int32_t>(std::nearbyint(static_cast<double>(b - a) * k / parts));
    };
    via.push_back({part(from.x, to.x), part(from.y, to.y)});
  }
  via.push_back(to);
}

}  // namespace

void pull_via_cells(const FreeSpace& space, const std::vector<CellIndex>& path, std::vector<CellIndex>& via) {
  WAITPOINT_CHECK(!path.empty(), "a way without cells");
  via = {path.front()};
  const double cells_max = std::max(1.0, space.parameters().leg_m_max / space.map().resolution_m());
  std::vector<std::size_t> anchors;
  find_anchors(space, path, anchors);
  for (std::size_t a = 0; a + 1 < anchors.size(); ++a) {
    for (std::size_t i = anchors[a]; i < anchors[a + 1];) {
      const std::size_t next = farthest_leg(space, path, i, anchors[a + 1]);
      add_leg(path[i], path[next], cells_max, via);
      i = next;
    }
  }
}

}  // namespace waitpoint::executive
