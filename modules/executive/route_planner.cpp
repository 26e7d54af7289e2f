// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/route_planner.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::executive {

const char* to_string(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::found: return "a route was found";
    case PlanOutcome::start_outside: return "the start is outside the map";
    case PlanOutcome::start_blocked: return "the start is shut in by obstacles";
    case PlanOutcome::goal_outside: return "the goal is outside the map";
    case PlanOutcome::goal_occupied: return "the goal lies in an obstacle";
    case PlanOutcome::goal_unknown: return "the goal lies in an unknown part of the map";
    case PlanOutcome::goal_too_close: return "the goal is too close to an obstacle for the robot";
    case PlanOutcome::unreachable: return "no way leads to the goal";
  }
  return "?";
}

PlanOutcome RoutePlanner::check_goal(Point goal) const {
  const std::optional<CellIndex> cell = space_.map().cell_at(goal);
  if (!cell) return PlanOutcome::goal_outside;
  switch (space_.map()[*cell]) {
    case Cell::occupied: return PlanOutcome::goal_occupied;
    case Cell::unknown: return PlanOutcome::goal_unknown;
    case Cell::free: break;
  }
  if (!space_.passable(*cell)) return PlanOutcome::goal_too_close;
  if (!space_.tight(*cell)) return PlanOutcome::found;
  for (int sixteenths = 0; sixteenths < 16; ++sixteenths)
    if (space_.fits(*cell, sixteenths)) return PlanOutcome::found;
  return PlanOutcome::goal_too_close;
}

void RoutePlanner::plan(Point start, Point goal, RoutePlan& plan) {
  plan.via_points.clear();
  plan.length_m = 0;
  plan.cost = 0;
  plan.outcome = check_goal(goal);
  if (plan.outcome != PlanOutcome::found) return;
  const std::optional<CellIndex> start_cell = space_.map().cell_at(start), goal_cell = space_.map().cell_at(goal);
  CellIndex from = start_cell ? *start_cell : edge_at(start);
  if (!space_.passable(from) && !escape(from, from))
    plan.outcome = start_cell ? PlanOutcome::start_blocked : PlanOutcome::start_outside;
  if (plan.outcome == PlanOutcome::found) {
    plan.cost = search_.find(space_, from, *goal_cell, path_);
    if (plan.cost == ShortestPath::unreachable) plan.outcome = PlanOutcome::unreachable;
  }
  if (plan.outcome != PlanOutcome::found) return;
  pull_via_cells(space_, path_, via_);
  if (from != start_cell) plan.via_points.push_back(space_.map().centre(from));
  for (std::size_t i = 1; i + 1 < via_.size(); ++i) plan.via_points.push_back(space_.map().centre(via_[i]));
  plan.via_points.push_back(goal);
  Point last = start;
  for (const Point p : plan.via_points) plan.length_m += length(p - last), last = p;
}

// The cell of the map nearest to a point outside.
CellIndex RoutePlanner::edge_at(Point outside) const {
  const OccupancyGrid& map = space_.map();
  const Point p = between(map.origin(), {outside.x, outside.y, 0}).position();
  const auto clamped = [&](double at_m, int cells) {
    return static_cast<int>(std::clamp(std::floor(at_m / map.resolution_m()), 0.0, static_cast<double>(cells - 1)));
  };
  return {clamped(p.x, map.width()), clamped(p.y, map.height())};
}

std::uint32_t RoutePlanner::remaining_cost(std::span<const CellIndex> path, Point robot) const {
  const auto from_robot = [&](CellIndex c) {
    const Point d = space_.map().centre(c) - robot;
    return dot(d, d);
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    if (from_robot(path[i]) < from_robot(path[nearest])) nearest = i;
  std::uint32_t cost = 0;
  for (std::size_t i = nearest + 1; i < path.size(); ++i) {
    if (!space_.keepable(path[i])) return ShortestPath::unreachable;
    const bool is_diagonal = path[i].x != path[i - 1].x && path[i].y != path[i - 1].y;
    cost += space_.cell_cost(path[i]) * (is_diagonal ? ShortestPath::diagonal_step : ShortestPath::straight_step);
  }
  return cost;
}

// The nearest passable cell in sight. The start itself may lie in a mark (an echo displaced by a position error), so
// only mapped cells block the view.
bool RoutePlanner::escape(CellIndex start, CellIndex& free) const {
  const auto reach = static_cast<std::int32_t>(space_.parameters().escape_m_max / space_.map().resolution_m());
  const auto in_sight = [&](CellIndex c) {
    const std::int32_t steps = std::max(std::abs(c.x - start.x), std::abs(c.y - start.y));
    for (std::int32_t k = 0; k <= steps; ++k) {
      const auto part = [&](std::int32_t a, std::int32_t b) {
        return a + static_cast<std::int32_t>(std::nearbyint(static_cast<double>(b - a) * k / std::max(steps, 1)));
      };
      const CellIndex between = {part(start.x, c.x), part(start.y, c.y)};
      if (space_.map()[between] == Cell::occupied) return false;
    }
    return true;
  };
  std::int32_t best = reach * reach + 1;
  for (std::int32_t row = -reach; row <= reach; ++row) {
    for (std::int32_t column = -reach; column <= reach; ++column) {
      const CellIndex c = {start.x + column, start.y + row};
      const std::int32_t square = column * column + row * row;
      if (square >= best || !space_.passable(c) || !in_sight(c)) continue;
      best = square;
      free = c;
    }
  }
  return best <= reach * reach;
}

}  // namespace waitpoint::executive
