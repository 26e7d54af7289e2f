// SPDX-License-Identifier: BSD-3-Clause
// Permitted positions for the centre of a robot: the known map, inflated, plus obstacles met on the way.
//
// A cell is passable if its centre is at least
//
//   hard = radius + clearance - resolution / sqrt(2)      (never less than the radius)
//
// from the nearest occupied square: then every point with the full radius + clearance lies in a passable cell, and
// points connected with that clearance are connected by passable cells, diagonal neighbours included. A straight step
// between two neighbouring cells reduces the distance by at most 3 mm for cells of 5 cm. Unknown cells are forbidden to
// the centre but are not inflated. Beyond `hard` the cost of a cell falls until the preferred clearance is reached.
//
// For a robot that is no disc, the radius is that of the greatest disc in its footprint. Where the least disc about it
// does not fit, a cell is tight: there fits() checks the hull itself, turned to one of 16 headings.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "core/fields.hpp"
#include "core/footprint.hpp"
#include "core/occupancy_grid.hpp"
#include "modules/executive/distance_transform.hpp"
#include "modules/executive/known_space.hpp"
#include "modules/executive/seen_map.hpp"
#include "modules/executive/tiled_grid.hpp"

namespace waitpoint::executive {

struct PlanningParameters {
  double robot_radius_m = 0.26;
  Bounded<Point, 64> footprint;
  double clearance_m = 0.05;
  double preferred_clearance_m = 0.55;
  double explained_m = 0.25;
  double narrow_m = 0.35;
  double approach_m = 0.5;
  double leg_m_max = 5.0;
  double escape_m_max = 1.0;

  static void fields(auto field) {
    field("robot_radius_m", &PlanningParameters::robot_radius_m,
          "of the smallest disc about the robot's centre that holds it");
    field("footprint", &PlanningParameters::footprint,
          "corners of its outline, convex, counter-clockwise; none: it is that disc");
    field("clearance_m", &PlanningParameters::clearance_m,
          "least clearance to each side; such passages are used if necessary");
    field("preferred_clearance_m", &PlanningParameters::preferred_clearance_m,
          "beyond the radius; no extra cost from here on");
    field("explained_m", &PlanningParameters::explained_m, "an echo this close to a mapped obstacle is not marked");
    field("narrow_m", &PlanningParameters::narrow_m, "passages with less clearance get a via point at each end");
    field("approach_m", &PlanningParameters::approach_m, "distance of these from the passage");
    field("leg_m_max", &PlanningParameters::leg_m_max, "between via points");
    field("escape_m_max", &PlanningParameters::escape_m_max, "from an impassable start to the nearest passable cell");
  }
};

class FreeSpace {
 public:
  FreeSpace(std::shared_ptr<const KnownSpace> known, const PlanningParameters& parameters);
  /// With a map that is not shared.
  FreeSpace(OccupancyGrid map, const PlanningParameters& parameters)
      : FreeSpace(std::make_shared<const KnownSpace>(std::move(map)), parameters) {}
  FreeSpace(FreeSpace&&) = default;

  const OccupancyGrid& map() const { return known_->map(); }
  const PlanningParameters& parameters() const { return parameters_; }

  /// Squared distance from a cell's centre to the nearest obstacle, in half cells; 0 for occupied or unknown cells, and
  /// outside the map.
  std::uint16_t clearance_square(CellIndex c) const {
    if (!map().contains(c)) return 0;
    const std::uint16_t known = known_square(c);
    const std::uint16_t mapped = marked() ? std::min(known, marks_(c.x, c.y)) : known;
    return seen_ == nullptr ? mapped : std::min(mapped, seen_square(c));
  }
  /// The distance from a cell's centre to the nearest obstacle, capped at 127 cells.
  double clearance_m(CellIndex c) const;
  /// A distance in metres as a squared clearance in half cells, rounded up.
  std::uint16_t square_of(double distance_m) const;

  bool passable(CellIndex c) const { return clearance_square(c) >= hard_square_; }
  /// True if a route that leads through a cell can be kept: it is passable but for half a cell, by which what is seen
  /// changes from scan to scan.
  bool keepable(CellIndex c) const { return clearance_square(c) >= keep_square_; }
  /// True if the robot fits there at some headings only, or at none; never, for a disc.
  bool tight(CellIndex c) const { return !hull_.empty() && clearance_square(c) < roomy_square_; }
  /// True if the hull about a cell's centre, turned by `sixteenths` of a full turn from the
  /// grid's x axis, keeps clear of all obstacles.
  bool fits(CellIndex c, int sixteenths) const;

  /// The cost of entering a passable cell, per fifth of its length; `least_cell_cost` in the open.
  std::uint32_t cell_cost(CellIndex c) const;
  /// The same by the known map alone, without marks and seen obstacles: never more.
  bool known_passable(CellIndex c) const { return map().contains(c) && known_square(c) >= hard_square_; }
  std::uint32_t known_cell_cost(CellIndex c) const { return cost_[std::min(known_square(c), preferred_square_)]; }
  static constexpr std::uint32_t least_cell_cost = 16, greatest_cell_cost = 80, unseen_cell_cost = 8;

  /// True if all cells touched by the segment between two cells' centres have at least this clearance.
  bool clear_line(CellIndex a, CellIndex b, std::uint16_t least_square) const;

  /// Adds obstacles at points of the map frame, except near mapped obstacles, which explain the echo.
  void mark(std::span<const Point> echoes);
  /// Deletes all marks.
  void forget();
  bool marked() const { return !marks_.empty(); }

  /// Takes over the obstacles that the robot has seen, in the place of those taken over before; those near mapped
  /// obstacles, which explain them, are left out. On a map that is not known, cells that the robot has not seen then
  /// cost more by unseen_cell_cost. `seen` is borrowed.
  void see(const SeenMap& seen);
  bool has_seen() const { return seen_ != nullptr; }

 private:
  std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(map().width()) + static_cast<std::size_t>(c.x);
  }
  void turn_hull(const Footprint& footprint);
  void push_away(CellIndex obstacle);
  std::uint16_t known_square(CellIndex c) const { return known_->clearances()[index(c)]; }
  bool explained(CellIndex c) const { return known_square(c) < explained_square_; }
  std::int32_t reach_cells() const;
  std::uint16_t seen_square(CellIndex c) const {
    const std::int32_t x = c.x - seen_low_.x, y = c.y - seen_low_.y;
    if (x < 0 || y < 0 || x >= seen_width_ || y >= seen_height_) return square_half_cells_max;
    return seen_squares_[static_cast<std::size_t>(y) * static_cast<std::size_t>(seen_width_) +
                         static_cast<std::size_t>(x)];
  }

  std::shared_ptr<const KnownSpace> known_;
  PlanningParameters parameters_;
  std::vector<std::vector<CellIndex>> hull_;  // offsets of the hull's points by heading; empty for a disc
  std::uint16_t roomy_square_ = 0, hull_square_ = 0;
  std::uint16_t hard_square_ = 0, keep_square_ = 0, preferred_square_ = 0, explained_square_ = 0;
  TiledGrid<std::uint16_t> marks_;  // squared clearances from marks; empty without marks
  std::vector<std::uint8_t> cost_;  // by squared clearance, up to preferred_square_
  // Of seen obstacles: squared clearances in a window about it; null: nothing.
  const SeenMap* seen_ = nullptr;
  CellIndex seen_low_;
  std::int32_t seen_width_ = 0, seen_height_ = 0;
  std::vector<Cell> seen_cells_;
  std::vector<std::uint16_t> seen_squares_;
};

}  // namespace waitpoint::executive
