// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace waitpoint::executive {

FreeSpace::FreeSpace(std::shared_ptr<const KnownSpace> known, const PlanningParameters& parameters)
    : known_(std::move(known)), parameters_(parameters) {
  const double radius = parameters_.robot_radius_m, half_diagonal = map().resolution_m() / std::sqrt(2.0);
  const double hard_m = std::max(radius, radius + parameters_.clearance_m - half_diagonal);
  const double preferred_m = std::max(hard_m, radius + parameters_.preferred_clearance_m);
  hard_square_ = square_of(hard_m);
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
  return cost_[std::min(clearance_square(c), preferred_square_)];
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
    if (!c || known_->clearances()[index(*c)] < explained_square_ || clearance_square(*c) == 0) continue;
    if (!marked()) marks_ = {map().width(), map().height(), square_half_cells_max};
    push_away(*c);
  }
}

void FreeSpace::push_away(CellIndex obstacle) {
  const auto edge = [](std::int32_t cells) { return std::max(0, 2 * std::abs(cells) - 1); };
  std::int32_t reach = 0;  // an obstacle has no effect beyond the preferred clearance
  while (edge(reach) * edge(reach) < preferred_square_) ++reach;
  const CellIndex low = {std::max(0, obstacle.x - reach), std::max(0, obstacle.y - reach)};
  const CellIndex high = {std::min(map().width() - 1, obstacle.x + reach),
                          std::min(map().height() - 1, obstacle.y + reach)};
  for (std::int32_t row = low.y; row <= high.y; ++row) {
    for (std::int32_t column = low.x; column <= high.x; ++column) {
      const std::int32_t dx = edge(column - obstacle.x), dy = edge(row - obstacle.y);
      std::uint16_t& square = marks_(column, row);
      square = static_cast<std::uint16_t>(std::min<std::int32_t>(square, dx * dx + dy * dy));
    }
  }
}

void FreeSpace::forget() { marks_ = {}; }

}  // namespace waitpoint::executive
