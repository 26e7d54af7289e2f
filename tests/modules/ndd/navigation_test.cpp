// SPDX-License-Identifier: BSD-3-Clause
// The navigator in a closed loop: corridors, doors, a dead end, clutter, other robots.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/modules/ndd/closed_loop.hpp"

namespace waitpoint::ndd {
namespace {

using test::ClosedLoop;
using test::DrivenRobot;
using test::Shapes;

struct Trip {
  Pose start;
  std::vector<Point> via;
};

// Drives the trips together; true if all arrive in time.
bool drive(ClosedLoop& loop, const std::vector<Trip>& trips, double seconds_max, const Pose& position_error = {}) {
  for (const Trip& trip : trips) loop.add({}, trip.start).position_error = position_error;
  for (int i = 0; i < 20; ++i) loop.step();
  for (std::size_t i = 0; i < trips.size(); ++i) loop.go(*loop.robots[i], trips[i].via);
  return loop.run(seconds_max);
}

double mean_speed(const DrivenRobot& robot) {
  return robot.driven_m / (10.0 * 0.01 * static_cast<double>(robot.path.size()));
}

void add_corridor(Shapes& shapes, double width) {
  shapes.wall(-2, width / 2, 22, width / 2 + 0.2);
  shapes.wall(-2, -width / 2 - 0.2, 22, -width / 2);
}

void add_door(Shapes& shapes, double width) {
  shapes.wall(4, width / 2, 4.2, 5);
  shapes.wall(4, -5, 4.2, -width / 2);
  shapes.wall(-2, 5, 12, 5.2);
  shapes.wall(-2, -5.2, 12, -5);
}

TEST(Navigation, DrivesStraightInTheOpenAndStopsAtTheGoal) {
  const Shapes shapes;
  ClosedLoop loop(shapes, 1);
  ASSERT_TRUE(drive(loop, {{{0, 0, 0}, {{10, 0}}}}, 20));
  const DrivenRobot& robot = *loop.robots[0];
  EXPECT_LT(length(robot.pose.position() - Point{10, 0}), 0.1);
  EXPECT_LT(robot.v_m_s, 0.06);
  EXPECT_GT(mean_speed(robot), 0.7);
  EXPECT_LT(robot.turned_rad, 0.01);
}

TEST(Navigation, TurnsInPlaceTowardsAGoalBehind) {
  const Shapes shapes;
  ClosedLoop loop(shapes, 1);
  ASSERT_TRUE(drive(loop, {{{0, 0, 0}, {{-5, 0}}}}, 20));
  const DrivenRobot& robot = *loop.robots[0];
  double farthest = 0;
  for (const Pose& p : robot.path) farthest = std::max(farthest, p.x);
  EXPECT_LT(farthest, 0.05);
  EXPECT_LT(robot.turned_rad, exact::pi + 0.4);  // one way round, not back and forth
  EXPECT_LT(robot.driven_m, 5.3);
}

TEST(Navigation, IntermediateViaPointsArePassedWithoutStopping) {
  const Shapes shapes;
  ClosedLoop loop(shapes, 1);
  DrivenRobot& robot = loop.add({}, {0, 0, 0});
  for (int i = 0; i < 20; ++i) loop.step();
  loop.go(robot, {{2, 0}, {4, 0.5}, {6, 0}, {8, 0.5}, {10, 0}});
  double slowest = 1;
  while (robot.pose.x < 9 && loop.now().seconds() < 30) {
    loop.step();
    if (robot.pose.x > 1) slowest = std::min(slowest, robot.v_m_s);
  }
  EXPECT_GT(slowest, 0.5);
  EXPECT_TRUE(loop.run(10));
}

TEST(Navigation, AnotherRouteIsTakenInMotionWithoutAHalt) {
  const Shapes shapes;
  ClosedLoop loop(shapes, 1);
  DrivenRobot& robot = loop.add({}, {0, 0, 0});
  EXPECT_FALSE(robot.navigator.reroute({}, std::vector<Point>{{5, 1}}));
  for (int i = 0; i < 20; ++i) loop.step();
  loop.go(robot, {{8, 0}});
  while (robot.pose.x < 3) loop.step();
  posters::PositionEstimate position;
  position.date = loop.now();
  position.pose = robot.pose;
  EXPECT_TRUE(robot.navigator.reroute(position, std::vector<Point>{{6, 1.5}, {9, 2}}));
  double slowest = 1;
  while (robot.pose.x < 7 && loop.now().seconds() < 30) {
    loop.step();
    slowest = std::min(slowest, robot.v_m_s);
  }
  EXPECT_GT(slowest, 0.5);
  EXPECT_TRUE(loop.run(10));
  EXPECT_LT(length(robot.pose.position() - Point{9, 2}), 0.15);
}

TEST(Navigation, DoesNotOscillateInCorridors) {
  struct Expected {
    double width_m, speed_m_s;
  };
  for (const Expected expected : {Expected{2.0, 0.7}, Expected{1.2, 0.5}, Expected{0.9, 0.35}}) {
    Shapes shapes;
    add_corridor(shapes, expected.width_m);
    ClosedLoop loop(shapes, 2);
    const double aside = 0.2 * (expected.width_m - 0.6);
    ASSERT_TRUE(drive(loop, {{{0, aside, 0.1}, {{20, 0}}}}, 70)) << expected.width_m;
    const DrivenRobot& robot = *loop.robots[0];
    EXPECT_GT(robot.least_clearance_m, 0.1);
    EXPECT_GT(mean_speed(robot), expected.speed_m_s) << expected.width_m;
    EXPECT_LE(robot.turn_changes, 8) << expected.width_m;
    EXPECT_LT(robot.turned_rad, 2.0) << expected.width_m;
    double overshoot = 0;  // beyond the axis
    for (const Pose& p : robot.path) overshoot = std::max(overshoot, -p.y);
    EXPECT_LT(overshoot, 0.05) << expected.width_m;
  }
}

TEST(Navigation, PassesDoorsStraightAndAtASlant) {
  for (const double width : {1.0, 0.9, 0.8, 0.64}) {
    const std::vector<Trip> trips = {{{0, 1, 0}, {{3.3, 0}, {4.9, 0}, {8, -2}}},
                                     {{3, -3, 1.57}, {{3.4, 0}, {4.8, 0}, {5.2, 3}}}};
    for (const Trip& trip : trips) {
      Shapes shapes;
      add_door(shapes, width);
      ClosedLoop loop(shapes, 3);
      ASSERT_TRUE(drive(loop, {trip}, 40)) << width;
      EXPECT_GT(loop.robots[0]->least_clearance_m, 0.02) << width;
      EXPECT_GT(mean_speed(*loop.robots[0]), 0.4) << width;
    }
  }
}

TEST(Navigation, PassesADoorWithAnErrorOfItsPosition) {
  Shapes shapes;
  add_door(shapes, 0.9);
  for (const Pose error : {Pose{0.1, 0.15, 0.03}, Pose{-0.1, -0.15, -0.03}}) {
    ClosedLoop loop(shapes, 4);
    ASSERT_TRUE(drive(loop, {{{0, 1, 0}, {{3.3, 0}, {4.9, 0}, {8, -2}}}}, 40, error));
    EXPECT_GT(loop.robots[0]->least_clearance_m, 0.05);
  }
}

TEST(Navigation, LeavesADeadEndAlongItsViaPoints) {
  Shapes shapes;
  shapes.wall(-1, 1.5, 4, 1.7);
  shapes.wall(-1, -1.7, 4, -1.5);
  shapes.wall(4, -1.7, 4.2, 1.7);
  ClosedLoop loop(shapes, 5);
  ASSERT_TRUE(drive(loop, {{{3, 0, 0}, {{-1.5, 0}, {-2, 2.5}, {5, 2.5}, {6, 0}}}}, 60));
  EXPECT_GT(loop.robots[0]->least_clearance_m, 0.2);
}

TEST(Navigation, ReportsAWayThatIsBlocked) {
  Shapes shapes;
  add_corridor(shapes, 2);
  shapes.wall(5, -1, 5.2, 1);
  ClosedLoop loop(shapes, 6);
  EXPECT_FALSE(drive(loop, {{{0, 0, 0}, {{10, 0}}}}, 60));
  EXPECT_EQ(loop.robots[0]->decision.outcome, RouteState::blocked);
  for (int i = 0; i < 150; ++i) loop.step();
  EXPECT_NEAR(loop.robots[0]->v_m_s, 0, 1e-9);
  EXPECT_GT(loop.robots[0]->least_clearance_m, 0.02);
}

TEST(Navigation, ReachesAGoalCloseToAWall) {
  Shapes shapes;
  shapes.wall(-2, 1, 12, 1.2);
  ClosedLoop loop(shapes, 7);
  ASSERT_TRUE(drive(loop, {{{0, 0, 0}, {{6, 1 - 0.31}}}}, 40));
  EXPECT_GT(loop.robots[0]->least_clearance_m, 0.01);
}

TEST(Navigation, GoalThatAnErrorPutsIntoAWallIsReachedAsNearAsCanBe) {
  Shapes shapes;
  shapes.wall(-2, 1, 12, 1.2);
  ClosedLoop loop(shapes, 7);
  ASSERT_TRUE(drive(loop, {{{0, 0, 0}, {{6, 1 - 0.31}}}}, 40, {0, -0.1, 0}));
  EXPECT_LT(length(loop.robots[0]->pose.position() - Point{6, 0.69}), 0.3);
  EXPECT_GT(loop.robots[0]->least_clearance_m, 0.01);
}

TEST(Navigation, FindsItsWayThroughDenseClutter) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Shapes shapes;
    const RandomStream random(seed, "test", "clutter");
    for (std::uint64_t k = 0; k < 60; ++k) {
      const test::Disc disc = {{2 + 10 * random.uniform(k, 0), -4 + 8 * random.uniform(k, 1)},
                               0.1 + 0.2 * random.uniform(k, 2)};
      bool apart = true;
      for (const test::Disc& other : shapes.discs)
        apart = apart && length(other.centre - disc.centre) > other.radius_m + disc.radius_m + 0.9;
      if (apart) shapes.discs.push_back(disc);
    }
    shapes.wall(-2, 4.5, 16, 4.7);
    shapes.wall(-2, -4.7, 16, -4.5);
    ClosedLoop loop(shapes, seed);
    ASSERT_TRUE(drive(loop, {{{0, 0, 0}, {{13.5, 0}}}}, 60)) << "seed " << seed;
    EXPECT_GT(loop.robots[0]->least_clearance_m, 0.05);
    EXPECT_GT(mean_speed(*loop.robots[0]), 0.4);
  }
}

TEST(Navigation, RobotsPassEachOtherInACorridor) {
  for (const double width : {2.0, 1.6}) {
    for (const double aside : {0.0, 0.05, -0.05, 0.3, -0.3}) {
      Shapes shapes;
      add_corridor(shapes, width);
      ClosedLoop loop(shapes, 8);
      ASSERT_TRUE(drive(loop, {{{0, aside, 0}, {{15, 0}}}, {{12, 0, exact::pi}, {{-1, 0}}}}, 40)) << width << aside;
      for (const auto& robot : loop.robots) {
        EXPECT_GT(robot->least_clearance_m, 0.03) << width << aside;
        EXPECT_GT(mean_speed(*robot), 0.4) << width << aside;
      }
    }
  }
}

TEST(Navigation, SixRobotsSwapPlacesAcrossACircle) {
  const Shapes shapes;
  std::vector<Trip> trips;
  for (int i = 0; i < 6; ++i) {
    const auto [s, c] = exact::sincos(i * exact::pi / 3);
    trips.push_back({{4 * c, 4 * s, exact::wrap_angle(i * exact::pi / 3 + exact::pi)}, {{-4 * c, -4 * s}}});
  }
  ClosedLoop loop(shapes, 9);
  ASSERT_TRUE(drive(loop, trips, 60));
  for (const auto& robot : loop.robots) EXPECT_GT(robot->least_clearance_m, 0.05);
}

TEST(Navigation, CrossingRobotsDoNotMeet) {
  const Shapes shapes;
  for (const double late : {0.0, 0.3, 0.6, 1.0}) {
    ClosedLoop loop(shapes, 10);
    ASSERT_TRUE(drive(loop, {{{0, 0, 0}, {{10, 0}}}, {{5, -5 - late, exact::pi / 2}, {{5, 5}}}}, 60)) << late;
    for (const auto& robot : loop.robots) EXPECT_GT(robot->least_clearance_m, 0.05) << late;
  }
}

TEST(Navigation, SameRunTwiceIsTheSameToTheBit) {
  Shapes shapes;
  add_door(shapes, 0.9);
  std::vector<Pose> paths[2];
  for (auto& path : paths) {
    ClosedLoop loop(shapes, 11);
    ASSERT_TRUE(drive(loop, {{{0, 1, 0}, {{3.3, 0}, {4.9, 0}, {8, -2}}}}, 40));
    path = loop.robots[0]->path;
  }
  EXPECT_EQ(paths[0], paths[1]);
}

}  // namespace
}  // namespace waitpoint::ndd
