// SPDX-License-Identifier: BSD-3-Clause
// Routes on the known map: from a point to a point, as via points, or the reason why there is none.
#pragma once

#include "modules/executive/shortest_path.hpp"
#include "modules/executive/via_points.hpp"

namespace waitpoint::executive {

enum class PlanOutcome : std::uint8_t {
  found,
  start_outside,   ///< the start is outside the map
  start_blocked,   ///< no passable cell near enough to the start can be reached from it
  goal_outside,    ///< the goal is outside the map
  goal_occupied,   ///< the goal lies in an obstacle
  goal_unknown,    ///< the goal lies where the map knows nothing
  goal_too_close,  ///< the goal is nearer to an obstacle than the robot's radius and clearance
  unreachable,     ///< free, but no way leads there
};

/// The outcome in words: "the goal lies in an obstacle".
const char* to_string(PlanOutcome outcome);

struct Plan {
  PlanOutcome outcome = PlanOutcome::unreachable;
  std::vector<Point> via_points;  ///< in the map frame, without the start; the last is the goal itself
  double length_m = 0;            ///< from the start over the via points
  std::uint32_t cost = 0;         ///< of the way over cells, in the units of ShortestPath
};

class RoutePlanner {
 public:
  RoutePlanner(std::shared_ptr<const KnownSpace> known, const PlanningParameters& parameters)
      : space_(std::move(known), parameters) {}
  /// With a map that nobody shares.
  RoutePlanner(OccupancyGrid map, const PlanningParameters& parameters) : space_(std::move(map), parameters) {}

  /// Plans with what is known and marked. A start that is not passable is first left for the nearest passable cell in
  /// sight. The plan's memory is reused.
  void plan(Point start, Point goal, Plan& plan);

  /// Whether a goal can be one at all: `found`, or one of the goal_ outcomes, by what is known and marked.
  PlanOutcome check_goal(Point goal) const;

  FreeSpace& space() { return space_; }
  const FreeSpace& space() const { return space_; }
  /// The cells of the last plan's way.
  const std::vector<CellIndex>& path() const { return path_; }

 private:
  bool escape(CellIndex start, CellIndex& free) const;

  FreeSpace space_;
  ShortestPath search_;
  std::vector<CellIndex> path_, via_;
};

}  // namespace waitpoint::executive
