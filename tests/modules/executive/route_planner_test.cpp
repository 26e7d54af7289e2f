// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/route_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/modules/executive/drawn_map.hpp"

namespace waitpoint::executive {
namespace {

// Two rooms of 3 m x 3 m side by side, 5 cm cells, a door of `door` cells at row 25 in the wall between.
std::vector<std::string> two_rooms(int door) {
  std::vector<std::string> rows;
  for (int r = 59; r >= 0; --r) {
    std::string row(122, ' ');
    if (r == 0 || r == 59) row = std::string(122, '#');
    row[0] = row[60] = row[61] = row[121] = '#';
    if (r >= 25 && r < 25 + door) row[60] = row[61] = ' ';
    rows.push_back(row);
  }
  return rows;
}

double distance_to_occupied(const OccupancyGrid& grid, Point p) {
  double best = 100;
  for (std::int32_t row = 0; row < grid.height(); ++row)
    for (std::int32_t column = 0; column < grid.width(); ++column) {
      if (grid[{column, row}] != Cell::occupied) continue;
      const double r = grid.resolution_m();
      const double dx = std::max({column * r - p.x, p.x - (column + 1) * r, 0.0});
      const double dy = std::max({row * r - p.y, p.y - (row + 1) * r, 0.0});
      best = std::min(best, std::sqrt(dx * dx + dy * dy));
    }
  return best;
}

TEST(RoutePlanner, RouteKeepsTheClearanceAllAlong) {
  for (const int door : {13, 14, 18, 24}) {
    RoutePlanner planner(test::drawn_map(two_rooms(door), 0.05), {});
    const Point start = {0.6, 2.5}, goal = {5.5, 0.7};
    RoutePlan plan;
    planner.plan(start, goal, plan);
    ASSERT_EQ(plan.outcome, PlanOutcome::found) << door;
    EXPECT_EQ(plan.via_points.back(), goal);
    const double least = 0.26 + 0.05 - 0.05 / std::sqrt(2.0) - 0.003;
    Point last = start;
    double length_m = 0;
    for (const Point p : plan.via_points) {
      for (int i = 0; i <= 40; ++i)
        EXPECT_GE(distance_to_occupied(planner.space().map(), last + (i / 40.0) * (p - last)), least);
      length_m += length(p - last);
      last = p;
    }
    EXPECT_NEAR(plan.length_m, length_m, 1e-9);
    EXPECT_LT(plan.length_m, 8);
  }
}

TEST(RoutePlanner, DoorHasAViaPointBeforeAndBehindIt) {
  RoutePlanner planner(test::drawn_map(two_rooms(18), 0.05), {});
  RoutePlan plan;
  planner.plan({0.6, 2.5}, {5.5, 2.5}, plan);
  ASSERT_EQ(plan.outcome, PlanOutcome::found);
  const auto beside = [&](double from_x, double to_x) {
    return std::any_of(plan.via_points.begin(), plan.via_points.end(),
                       [&](Point p) { return p.x > from_x && p.x < to_x && std::fabs(p.y - 1.7) < 0.3; });
  };
  EXPECT_TRUE(beside(1.9, 2.9));
  EXPECT_TRUE(beside(3.2, 4.2));
  EXPECT_LE(plan.via_points.size(), 8u);
}

TEST(RoutePlanner, StraightWayInTheOpenIsOneLegDividedIfLong) {
  RoutePlanner planner(test::drawn_map(std::vector<std::string>(100, std::string(400, ' ')), 0.05), {});
  RoutePlan plan;
  planner.plan({1, 1}, {4.5, 2}, plan);
  EXPECT_EQ(plan.via_points.size(), 1u);
  planner.plan({1, 1}, {19, 4}, plan);
  EXPECT_EQ(plan.via_points.size(), 4u);
  EXPECT_NEAR(plan.length_m, std::sqrt(18.0 * 18 + 9), 0.1);
}

PlanningParameters of_a_rectangle(double length_m, double width_m) {
  PlanningParameters parameters;
  parameters.robot_radius_m = 0.5 * exact::hypot(length_m, width_m);
  for (const Point corner : {Point{1, 1}, Point{-1, 1}, Point{-1, -1}, Point{1, -1}})
    parameters.footprint.push_back({0.5 * length_m * corner.x, 0.5 * width_m * corner.y});
  return parameters;
}

TEST(RoutePlanner, ARectangleGoesThroughADoorThatIsTooNarrowForTheDiscAboutIt) {
  const OccupancyGrid map = test::drawn_map(two_rooms(11), 0.05);  // 0.55 m
  PlanningParameters disc;
  disc.robot_radius_m = of_a_rectangle(0.42, 0.43).robot_radius_m;
  RoutePlan plan;
  RoutePlanner(map, disc).plan({0.6, 2.5}, {5.5, 0.7}, plan);
  EXPECT_EQ(plan.outcome, PlanOutcome::unreachable);
  RoutePlanner planner(map, of_a_rectangle(0.42, 0.43));
  planner.plan({0.6, 2.5}, {5.5, 0.7}, plan);
  ASSERT_EQ(plan.outcome, PlanOutcome::found);
  for (std::size_t i = 1; i < planner.path().size(); ++i) {  // in the door it goes straight through
    const CellIndex c = planner.path()[i], before = planner.path()[i - 1];
    EXPECT_TRUE(c.x < 58 || c.x > 63 || c.y == before.y) << i;
  }
}

// A corridor with a bend: `room` cells are added around its corner.
std::vector<std::string> bend(int room) {
  std::vector<std::string> rows(60, std::string(60, '#'));
  const auto clear = [&](int x, int y, int width, int height) {
    for (int row = y; row < y + height; ++row)
      rows[static_cast<std::size_t>(59 - row)].replace(static_cast<std::size_t>(x), static_cast<std::size_t>(width),
                                                       static_cast<std::size_t>(width), ' ');
  };
  clear(2, 10, 40, 12);
  clear(30, 10, 12, 48);
  clear(30 - room, 10 - room, 12 + 2 * room, 12 + 2 * room);
  return rows;
}

TEST(RoutePlanner, ALongRobotTurnsOnlyWhereItsHullSweepsFreeSpace) {
  const PlanningParameters parameters = of_a_rectangle(0.9, 0.42);
  RoutePlan plan;
  RoutePlanner(test::drawn_map(bend(0), 0.05), parameters).plan({0.9, 0.8}, {1.8, 2.3}, plan);
  EXPECT_EQ(plan.outcome, PlanOutcome::unreachable);
  RoutePlanner(test::drawn_map(bend(7), 0.05), parameters).plan({0.9, 0.8}, {1.8, 2.3}, plan);
  EXPECT_EQ(plan.outcome, PlanOutcome::found);
}

TEST(RoutePlanner, EveryReasonIsTold) {
  std::vector<std::string> rows = two_rooms(0);  // no door
  for (int r = 40; r < 50; ++r) rows[static_cast<std::size_t>(r)].replace(100, 10, "??????????");
  RoutePlanner planner(test::drawn_map(rows, 0.05), {});
  RoutePlan plan;
  const auto outcome = [&](Point start, Point goal) {
    planner.plan(start, goal, plan);
    return plan.outcome;
  };
  const Point inside = {1.5, 1.5};
  EXPECT_EQ(outcome(inside, {1, 1}), PlanOutcome::found);
  EXPECT_EQ(outcome(inside, {5, 1.5}), PlanOutcome::unreachable);
  EXPECT_TRUE(plan.via_points.empty());
  EXPECT_EQ(outcome(inside, {3.05, 1.5}), PlanOutcome::goal_occupied);
  EXPECT_EQ(outcome(inside, {5.2, 0.7}), PlanOutcome::goal_unknown);
  EXPECT_EQ(outcome(inside, {0.2, 1.5}), PlanOutcome::goal_too_close);
  EXPECT_EQ(outcome(inside, {-0.2, 1.5}), PlanOutcome::goal_outside);
  EXPECT_EQ(outcome({70, 1}, inside), PlanOutcome::start_outside);
}

TEST(RoutePlanner, FromBeyondTheEdgeOfTheMapTheRouteBeginsAtItsNearestCell) {
  RoutePlanner planner(test::drawn_map(std::vector<std::string>(40, std::string(60, ' ')), 0.05), {});
  RoutePlan plan;
  planner.plan({3.8, 1.01}, {0.5, 1}, plan);  // the map ends at x = 3
  ASSERT_EQ(plan.outcome, PlanOutcome::found);
  EXPECT_LT(length(plan.via_points.front() - Point{2.975, 1.025}), 1e-9);
  EXPECT_GT(plan.length_m, 3.2);
}

TEST(RoutePlanner, RemainingCostFallsAlongTheRoute) {
  RoutePlanner planner(test::drawn_map(two_rooms(20), 0.05), {});
  RoutePlan plan;
  planner.plan({0.625, 2.525}, {5.525, 0.725}, plan);
  const std::vector<CellIndex> path = planner.path();
  EXPECT_EQ(planner.remaining_cost(path, {0.625, 2.525}), plan.cost);
  EXPECT_LT(planner.remaining_cost(path, planner.space().map().centre(path[path.size() / 2])), plan.cost);
  EXPECT_EQ(planner.remaining_cost(path, {5.525, 0.725}), 0u);
  const Point on_the_route = planner.space().map().centre(path[path.size() / 2]);
  planner.space().mark(std::vector<Point>{on_the_route});
  ASSERT_TRUE(planner.space().marked());
  EXPECT_EQ(planner.remaining_cost(path, {0.625, 2.525}), ShortestPath::unreachable);
}

TEST(RoutePlanner, StartInTheInflationIsLeftOnItsOwnSideOfTheWall) {
  RoutePlanner planner(test::drawn_map(two_rooms(20), 0.05), {});
  RoutePlan plan;
  planner.plan({2.95, 0.5}, {5.5, 0.5}, plan);  // 5 cm before the wall
  ASSERT_EQ(plan.outcome, PlanOutcome::found);
  EXPECT_LT(plan.via_points.front().x, 2.8);
  EXPECT_GT(plan.via_points.front().x, 2.6);
}

TEST(RoutePlanner, StartThatIsShutInIsToldSo) {
  std::vector<std::string> rows(60, std::string(60, ' '));
  for (std::size_t i = 25; i < 35; ++i) rows[25][i] = rows[34][i] = rows[i][25] = rows[i][34] = '#';
  RoutePlanner planner(test::drawn_map(rows, 0.05), {});
  RoutePlan plan;
  planner.plan({1.5, 1.5}, {0.5, 0.5}, plan);
  EXPECT_EQ(plan.outcome, PlanOutcome::start_blocked);
}

TEST(RoutePlanner, MarkedObstacleIsPlannedRound) {
  std::vector<std::string> rows = two_rooms(18);
  for (std::size_t r = 41; r < 57; ++r) rows[r].replace(60, 2, "  ");  // a second door, farther down
  RoutePlanner planner(test::drawn_map(rows, 0.05), {});
  RoutePlan plan;
  planner.plan({1.5, 1.7}, {4.6, 1.7}, plan);
  const double direct_m = plan.length_m;
  EXPECT_LT(direct_m, 3.3);
  const std::vector<Point> echoes = {{3.05, 1.6}, {3.05, 1.7}, {3.05, 1.8}};
  planner.space().mark(echoes);
  planner.plan({1.5, 1.7}, {4.6, 1.7}, plan);
  ASSERT_EQ(plan.outcome, PlanOutcome::found);
  EXPECT_GT(plan.length_m, direct_m + 0.3);
  planner.space().forget();
  planner.plan({1.5, 1.7}, {4.6, 1.7}, plan);
  EXPECT_NEAR(plan.length_m, direct_m, 1e-9);
}

// Passages of just the radius plus 5 cm on each side, anywhere on the grid, are used if there is no other route.
TEST(RoutePlanner, TightestPassageIsFoundInAllPlacesOnTheGrid) {
  for (int columns = 12; columns <= 14; ++columns) {
    RoutePlanner planner(test::drawn_map(two_rooms(columns), 0.05), {});
    RoutePlan plan;
    planner.plan({1.5, 1.5}, {4.6, 1.5}, plan);
    const bool wide_enough = columns * 0.05 >= 2 * 0.31;
    if (wide_enough) {
      EXPECT_EQ(plan.outcome, PlanOutcome::found) << columns;
    }
    if (columns * 0.05 < 2 * 0.26) {
      EXPECT_EQ(plan.outcome, PlanOutcome::unreachable) << columns;
    }
  }
}

}  // namespace
}  // namespace waitpoint::executive
