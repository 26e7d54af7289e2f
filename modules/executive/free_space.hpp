// SPDX-License-Identifier: BSD-3-Clause
// Where the centre of a round robot may be: the known map, inflated, plus obstacles that were met on the way.
//
// A cell is passable if its centre is at least
//
//   hard = radius + clearance - resolution / sqrt(2)      (never less than the radius)
//
// from the nearest occupied square: then every point with the full radius + clearance lies in a passable cell, and
// whatever is connected with that clearance is connected here, cell to neighbouring cell, diagonals included. A
// straight step between two neighbouring cells comes nearer by at most 3 mm at 5 cm cells. Unknown cells are closed to
// the centre but push nobody away. Beyond `hard` the cost of a cell falls until the preferred clearance is reached.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/fields.hpp"
#include "core/occupancy_grid.hpp"
#include "modules/executive/distance_transform.hpp"
#include "modules/executive/known_space.hpp"

namespace waitpoint::executive {

struct PlanningParameters {
  double robot_radius_m = 0.26;
  double clearance_m = 0.05;            ///< any passage this much wider to each side is used, if it must be
  double preferred_clearance_m = 0.55;  ///< beyond the radius, costs nothing extra
  double explained_m = 0.25;            ///< an echo this near to a mapped obstacle is that obstacle
  double narrow_m = 0.35;               ///< a passage with less clearance gets via points before and behind it
  double approach_m = 0.5;              ///< these are this far from it
  double leg_m_max = 5.0;               ///< between via points
  double escape_m_max = 1.0;            ///< from a start that is not passable to the nearest cell that is

  static constexpr auto fields() {
    return std::tuple(
        field("robot_radius_m", &PlanningParameters::robot_radius_m),
        field("clearance_m", &PlanningParameters::clearance_m),
        field("preferred_clearance_m", &PlanningParameters::preferred_clearance_m),
        field("explained_m", &PlanningParameters::explained_m), field("narrow_m", &PlanningParameters::narrow_m),
        field("approach_m", &PlanningParameters::approach_m), field("leg_m_max", &PlanningParameters::leg_m_max),
        field("escape_m_max", &PlanningParameters::escape_m_max));
  }
};

class FreeSpace {
 public:
  FreeSpace(std::shared_ptr<const KnownSpace> known, const PlanningParameters& parameters);
  /// Of a map that nobody shares.
  FreeSpace(OccupancyGrid map, const PlanningParameters& parameters)
      : FreeSpace(std::make_shared<const KnownSpace>(std::move(map)), parameters) {}
  FreeSpace(FreeSpace&&) = default;

  const OccupancyGrid& map() const { return known_->map(); }
  const PlanningParameters& parameters() const { return parameters_; }

  /// Squared distance from a cell's centre to the nearest obstacle, in half cells; 0 for cells that are occupied,
  /// unknown or outside.
  std::uint16_t clearance_square(CellIndex c) const { return map().contains(c) ? clearance_[index(c)] : 0; }
  /// The distance from a cell's centre to the nearest obstacle, told up to 127 cells.
  double clearance_m(CellIndex c) const;
  /// The least squared clearance, in half cells, that a distance in metres needs.
  std::uint16_t square_of(double distance_m) const;

  bool passable(CellIndex c) const { return clearance_square(c) >= hard_square_; }
  /// What entering a passable cell costs per fifth of a cell's length: `least_cell_cost` where there is room.
  std::uint32_t cell_cost(CellIndex c) const;
  static constexpr std::uint32_t least_cell_cost = 16, greatest_cell_cost = 80;

  /// Whether all cells that the segment between two cells' centres touches have at least this clearance.
  bool clear_line(CellIndex a, CellIndex b, std::uint16_t least_square) const;

  /// Adds obstacles at points of the map frame, except where the map has one near enough to explain the echo.
  void mark(std::span<const Point> echoes);
  /// Forgets all that was marked.
  void forget();
  bool marked() const { return !marked_.empty(); }

 private:
  std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(map().width()) + static_cast<std::size_t>(c.x);
  }
  void push_away(CellIndex obstacle);

  std::shared_ptr<const KnownSpace> known_;
  PlanningParameters parameters_;
  std::uint16_t hard_square_ = 0, preferred_square_ = 0, explained_square_ = 0;
  std::vector<std::uint16_t> marked_;         // clearances with what was marked; empty: nothing was
  const std::uint16_t* clearance_ = nullptr;  // those, or the map's
  std::vector<std::uint8_t> cost_;            // by squared clearance, up to preferred_square_
};

}  // namespace waitpoint::executive
