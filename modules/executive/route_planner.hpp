// SPDX-License-Identifier: BSD-3-Clause
// Routes on the known map between two points, as via points, or the reason for there being none.
#pragma once

#include "modules/executive/shortest_path.hpp"
#include "modules/executive/via_points.hpp"

namespace waitpoint::executive {

enum class PlanOutcome : std::uint8_t {
  found,
  start_outside,   ///< the start is outside the map, and its edge is closed there
  start_blocked,   ///< no passable cell near the start is in sight
  goal_outside,    ///< the goal is outside the map
  goal_occupied,   ///< the goal lies in an obstacle
  goal_unknown,    ///< the goal lies in an unknown area of the map
  goal_too_close,  ///< the goal is nearer to an obstacle than the robot's radius and clearance
  unreachable,     ///< the goal is free, but there is no way to it
};

/// The outcome as a phrase: "the goal lies in an obstacle".
const char* to_string(PlanOutcome outcome);

struct RoutePlan {
  PlanOutcome outcome = PlanOutcome::unreachable;
  std::vector<Point> via_points;  ///< in the map frame, without the start; the last is the goal itself
  double length_m = 0;            ///< from the start over the via points
  std::uint32_t cost = 0;         ///< of the path of cells, in the units of ShortestPath
};

class RoutePlanner {
 public:
  RoutePlanner(std::shared_ptr<const KnownSpace> known, const PlanningParameters& parameters)
      : space_(std::move(known), parameters) {}
  /// With a map that is not shared.
  RoutePlanner(OccupancyGrid map, const PlanningParameters& parameters) : space_(std::move(map), parameters) {}

  /// Plans with the known map and its marks. From an impassable start the route first goes to the nearest passable cell
  /// in sight; from one outside the map, to the map's nearest cell, or one in its sight. The plan's memory is reused.
  void plan(Point start, Point goal, RoutePlan& plan);

  /// The cost of the rest of a path of cells, from that nearest to `robot` on, as of now; unreachable if a cell of
  /// it can no longer be kept.
  std::uint32_t remaining_cost(std::span<const CellIndex> path, Point robot) const;

  /// The state of a goal by the known map and its marks: `found` if it is valid, or one of the goal_ outcomes.
  PlanOutcome check_goal(Point goal) const;

  FreeSpace& space() { return space_; }
  const FreeSpace& space() const { return space_; }
  /// The cells of the last plan.
  const std::vector<CellIndex>& path() const { return path_; }

 private:
  bool escape(CellIndex start, CellIndex& free) const;
  CellIndex edge_at(Point outside) const;

  FreeSpace space_;
  ShortestPath search_;
  std::vector<CellIndex> path_, via_;
};

}  // namespace waitpoint::executive
