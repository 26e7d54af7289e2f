// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace waitpoint::executive {
namespace {

std::int32_t half_cells_to_edge(std::int32_t cells) { return std::max(0, 2 * std::abs(cells) - 1); }

}  // namespace

FreeSpace::FreeSpace(std::shared_ptr<const KnownSpace> known, const PlanningParameters& parameters)
    : known_(std::move(known)), parameters_(parameters) {
  const Footprint footprint({parameters_.footprint.begin(), parameters_.footprint.size()}, parameters_.robot_radius_m);
  const double half_diagonal = map().resolution_m() / std::sqrt(2.0);
  const auto hard_of = [&](double radius_m) {
    return std::max(radius_m, radius_m + parameters_.clearance_m - half_diagonal);
  };
  const double hard_m = hard_of(footprint.inner_radius_m());
  const double preferred_m = std::max(hard_m, footprint.radius_m() + parameters_.preferred_clearance_m);
  if (!footprint.is_disc()) {
    turn_hull(footprint);
    roomy_square_ = square_of(hard_of(footprint.radius_m()));
    hull_square_ = square_of(std::max(parameters_.clearance_m, half_diagonal));
  }
  hard_square_ = square_of(hard_m);
  keep_square_ = square_of(footprint.inner_radius_m() - 0.5 * map().resolution_m());
  preferred_square_ = square_of(preferred_m);
  explained_square_ = square_of(parameters_.explained_m);
  cost_.resize(preferred_square_ + std::size_t{1});
  for (std::size_t square = 0; square < cost_.size(); ++square) {
    const double distance = 0.5 * map().resolution_m() * std::sqrt(static_cast<double>(square));
    const double lack =
        preferred_m > hard_m ? std::clamp((preferred_m - distance) / (preferred_m - hard_m), 0.0, 1.0) : 0;
    cost_[square] = static_cast<std::uint8_t>(
        std::nearbyint(least_cell_cost + static_cast<double>(greatest_cell_cost - least_cell_cost) * lack * lack));
  }
}

void FreeSpace::turn_hull(const Footprint& footprint) {
  constexpr int headings = 16;
  hull_.resize(headings);
  const double resolution_m = map().resolution_m();
  for (int i = 0; i < headings; ++i) {
    std::vector<CellIndex>& offsets = hull_[static_cast<std::size_t>(i)];
    for (const Point p : footprint.hull_points(resolution_m)) {
      const Point turned = transform({0, 0, 2 * exact::pi * i / headings}, p);
      offsets.push_back({static_cast<int>(std::nearbyint(turned.x / resolution_m)),
                         static_cast<int>(std::nearbyint(turned.y / resolution_m))});
    }
    std::sort(offsets.begin(), offsets.end());
    offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
  }
}

bool FreeSpace::fits(CellIndex c, int sixteenths) const {
  if (hull_.empty()) return passable(c);
  const std::vector<CellIndex>& offsets = hull_[static_cast<std::size_t>(sixteenths & 15)];
  return std::all_of(offsets.begin(), offsets.end(), [&](CellIndex d) {
    return clearance_square({c.x + d.x, c.y + d.y}) >= hull_square_;
  });
}

std::uint16_t FreeSpace::square_of(double distance_m) const {
  const double half_cells = 2 * distance_m / map().resolution_m();
  // Rounding must not lose a distance of a whole number of half cells.
  const double square = std::ceil(half_cells * half_cells * (1 - 1e-12));
  return static_cast<std::uint16_t>(std::clamp(square, 1.0, static_cast<double>(square_half_cells_max)));
}

double FreeSpace::clearance_m(CellIndex c) const {
  return 0.5 * map().resolution_m() * std::sqrt(static_cast<double>(clearance_square(c)));
}

std::uint32_t FreeSpace::cell_cost(CellIndex c) const {
  const std::uint32_t unseen = seen_ != nullptr && !known_->is_known() && !seen_->seen(c) ? unseen_cell_cost : 0;
  return cost_[std::min(clearance_square(c), preferred_square_)] + unseen;
}

// An exact traversal: in half cells, boundaries between cells are at odd numbers of steps, and the side of
// the segment on which a crossing lies is decided in integers.
bool FreeSpace::clear_line(CellIndex a, CellIndex b, std::uint16_t least_square) const {
  const std::int64_t dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
  const std::int32_t step_x = b.x > a.x ? 1 : -1, step_y = b.y > a.y ? 1 : -1;
  CellIndex c = a;
  std::int64_t crossed_x = 0, crossed_y = 0;
  while (true) {
    if (clearance_square(c) < least_square) return false;
    if (c == b) return true;
    // The next vertical boundary is at (2 crossed_x + 1) / (2 dx) of the segment; the next horizontal one likewise.
    const std::int64_t vertical = (2 * crossed_x + 1) * dy, horizontal = (2 * crossed_y + 1) * dx;
    if (vertical <= horizontal && crossed_x < dx) c.x += step_x, ++crossed_x;
    if (horizontal <= vertical && crossed_y < dy) c.y += step_y, ++crossed_y;
  }
}

void FreeSpace::mark(std::span<const Point> echoes) {
  for (const Point echo : echoes) {
    const std::optional<CellIndex> c = map().cell_at(echo);
    if (!c || explained(*c) || clearance_square(*c) == 0) continue;
    if (!marked()) marks_ = {map().width(), map().height(), square_half_cells_max};
    push_away(*c);
  }
}

// An obstacle has no effect beyond the preferred clearance.
std::int32_t FreeSpace::reach_cells() const {
  std::int32_t reach = 0;
  while (half_cells_to_edge(reach) * half_cells_to_edge(reach) < preferred_square_) ++reach;
  return reach;
}

void FreeSpace::push_away(CellIndex obstacle) {
  const std::int32_t reach = reach_cells();
  const CellIndex low = {std::max(0, obstacle.x - reach), std::max(0, obstacle.y - reach)};
  const CellIndex high = {std::min(map().width() - 1, obstacle.x + reach),
                          std::min(map().height() - 1, obstacle.y + reach)};
  for (std::int32_t row = low.y; row <= high.y; ++row) {
    for (std::int32_t column = low.x; column <= high.x; ++column) {
      const std::int32_t dx = half_cells_to_edge(column - obstacle.x), dy = half_cells_to_edge(row - obstacle.y);
      std::uint16_t& square = marks_(column, row);
      square = static_cast<std::uint16_t>(std::min<std::int32_t>(square, dx * dx + dy * dy));
    }
  }
}

void FreeSpace::forget() { marks_ = {}; }

void FreeSpace::see(const SeenMap& seen) {
  seen_ = &seen;
  CellIndex low = {map().width(), map().height()}, high = {-1, -1};
  const auto is_obstacle = [&](CellIndex c) { return seen.occupied(c) && !explained(c); };
  for (const CellIndex c : seen.ever_occupied()) {
    if (!is_obstacle(c)) continue;
    low = {std::min(low.x, c.x), std::min(low.y, c.y)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y)};
  }
  const std::int32_t reach = reach_cells();
  low = {std::max(0, low.x - reach), std::max(0, low.y - reach)};
  high = {std::min(map().width() - 1, high.x + reach), std::min(map().height() - 1, high.y + reach)};
  seen_low_ = low;
  seen_width_ = std::max(0, high.x - low.x + 1);
  seen_height_ = std::max(0, high.y - low.y + 1);
  const std::size_t count = static_cast<std::size_t>(seen_width_) * static_cast<std::size_t>(seen_height_);
  seen_cells_.assign(count, Cell::free);
  seen_squares_.resize(count);
  if (count == 0) return;
  for (const CellIndex c : seen.ever_occupied())
    if (is_obstacle(c))
      seen_cells_[static_cast<std::size_t>(c.y - low.y) * static_cast<std::size_t>(seen_width_) +
                  static_cast<std::size_t>(c.x - low.x)] = Cell::occupied;
  DistanceTransform().run(seen_cells_, seen_width_, seen_height_, seen_squares_);
}

}  // namespace waitpoint::executive
