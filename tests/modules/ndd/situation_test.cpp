// SPDX-License-Identifier: BSD-3-Clause
// The six situations, each with a diagram made for it, and the directions that they require.
#include "modules/ndd/situation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/modules/ndd/points.hpp"

namespace waitpoint::ndd {
namespace {

constexpr double radius = 0.26, security = 0.4;

// A point at this hull distance.
Point near(double hull_distance, double degrees) { return polar(radius + hull_distance, degrees); }

Choice towards_goal(double degrees) { return {true, true, {0, sector_count, true, true}, false, polar(3, degrees)}; }

Choice towards_region(double first_degrees, double last_degrees, bool at_right_edge) {
  const int first = Diagram::sector_at(first_degrees * degree), last = Diagram::sector_at(last_degrees * degree);
  return {true, false, {first, static_cast<int>(Diagram::wrap(last - first)) + 1, true, true}, at_right_edge, {1, 0}};
}

Assessment assess(const std::vector<Point>& points, const Choice& choice) {
  const Diagram diagram = diagram_of(points);
  return with_obstacles(diagram, high_safety(diagram, choice, radius, security), radius, security);
}

TEST(Situation, NoRegionIsNowhereToGo) { EXPECT_EQ(assess({}, {}).situation, Situation::no_region); }

TEST(Situation, HSGRHeadsForTheGoal) {
  const Assessment a = assess({near(0.5, 60)}, towards_goal(20));
  EXPECT_EQ(a.situation, Situation::high_safety_goal_region);
  EXPECT_NEAR(a.direction_rad, 20 * degree, 1e-12);
  EXPECT_EQ(a.safety, 1);
}

TEST(Situation, HSWRKeepsASecurityDistanceFromTheRegionsEdge) {
  const double beside = exact::atan2(radius + security, 2.0);
  const Assessment left_of_it = assess({polar(2, -20)}, towards_region(-18, 90, true));
  EXPECT_EQ(left_of_it.situation, Situation::high_safety_wide_region);
  EXPECT_NEAR(left_of_it.direction_rad, -20 * degree + beside, 1e-12);
  const Assessment right_of_it = assess({polar(2, 20)}, towards_region(-90, 18, false));
  EXPECT_EQ(right_of_it.situation, Situation::high_safety_wide_region);
  EXPECT_NEAR(right_of_it.direction_rad, 20 * degree - beside, 1e-12);
}

TEST(Situation, HSNRTakesTheMiddleOfTheRegion) {
  const Assessment a = assess({polar(2, 10), polar(2, 52)}, towards_region(12, 50, true));
  EXPECT_EQ(a.situation, Situation::high_safety_narrow_region);
  EXPECT_NEAR(a.direction_rad, 31 * degree, 1e-9);
}

TEST(Situation, LSGRTurnsFromTheObstacleTheMoreTheNearerItIs) {
  const Assessment far = assess({near(0.3, 40)}, towards_goal(0));
  EXPECT_EQ(far.situation, Situation::low_safety_goal_region);
  EXPECT_NEAR(far.safety, 0.75, 1e-12);
  EXPECT_NEAR(far.direction_rad, 0.25 * -140 * degree, 1e-9);
  const Assessment close = assess({near(0.2, 40)}, towards_goal(0));
  EXPECT_NEAR(close.direction_rad, 0.5 * -140 * degree, 1e-9);
  const Assessment other_side = assess({near(0.2, -40)}, towards_goal(0));
  EXPECT_NEAR(other_side.direction_rad, 0.5 * 140 * degree, 1e-9);
}

TEST(Situation, LS1TurnsFromTheObstacleOffTheRegionsDirection) {
  const Assessment a = assess({polar(2, 10), polar(2, 52), near(0.3, 80)}, towards_region(12, 50, true));
  EXPECT_EQ(a.situation, Situation::low_safety_one_side);
  EXPECT_NEAR(a.direction_rad, (0.75 * 31 + 0.25 * (80 - 180)) * degree, 1e-9);
}

TEST(Situation, LS2GoesBetweenObstaclesOnBothSides) {
  const Assessment even = assess({near(0.2, 60), near(0.2, -60)}, towards_goal(0));
  EXPECT_EQ(even.situation, Situation::low_safety_two_sides);
  EXPECT_NEAR(even.direction_rad, 0, 1e-12);
  const Assessment nearer_left = assess({near(0.1, 60), near(0.3, -60)}, towards_goal(0));
  EXPECT_NEAR(nearer_left.direction_rad, -0.5 * 90 * degree, 1e-9);
  EXPECT_NEAR(nearer_left.safety, 0.25, 1e-12);
  const Assessment nearer_right = assess({near(0.3, 60), near(0.1, -60)}, towards_goal(10));
  EXPECT_NEAR(nearer_right.direction_rad, (10 + 0.5 * 80) * degree, 1e-9);
}

TEST(Situation, LS2TouchingOneSideTurnsARightAngleToTheOther) {
  const Assessment a = assess({near(0, 60), near(0.3, -60)}, towards_goal(0));
  EXPECT_NEAR(a.direction_rad, -90 * degree, 1e-9);
  EXPECT_EQ(a.safety, 0);
}

TEST(Situation, DirectionIsNeverBehind) {
  EXPECT_NEAR(assess({}, towards_goal(170)).direction_rad, 90 * degree, 1e-12);
  EXPECT_NEAR(assess({}, towards_goal(-170)).direction_rad, -90 * degree, 1e-12);
  EXPECT_NEAR(assess({near(0.1, 30)}, towards_goal(-80)).direction_rad, -90 * degree, 1e-12);
}

TEST(Situation, ObstaclesBehindDoNotCount) {
  EXPECT_EQ(assess({near(0.05, 150), near(0.05, -150)}, towards_goal(0)).situation, Situation::high_safety_goal_region);
}

// An obstacle straight ahead, the goal at +-180 degrees: the sign of zero and of pi must not flip the robot's
// direction.
TEST(Situation, BoundariesOfTheCircleDoNotFlipTheDirection) {
  for (const double goal : {179.9, -179.9}) {
    const Assessment a = assess({near(0.2, 90)}, towards_goal(goal));
    EXPECT_NEAR(std::fabs(a.direction_rad), 90 * degree, 1e-9);
  }
  const Assessment on_the_way = assess({near(0.2, 0)}, towards_goal(0));
  EXPECT_NEAR(on_the_way.direction_rad, -90 * degree, 1e-9);
  const Assessment just_left = assess({near(0.2, 0.01)}, towards_goal(0));
  EXPECT_NEAR(just_left.direction_rad, -90 * degree, 0.02);
}

}  // namespace
}  // namespace waitpoint::ndd
