// SPDX-License-Identifier: BSD-3-Clause
// The memory of obstacles, and the progress along a route.
#include "modules/ndd/obstacle_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "modules/ndd/progress_watch.hpp"
#include "modules/ndd/route.hpp"
#include "tests/modules/milliseconds.hpp"
#include "tests/modules/ndd/scan_from.hpp"

namespace waitpoint::ndd {
namespace {

double nearest(const std::vector<Point>& points, Point p) {
  double best = 100;
  for (const Point q : points) best = std::min(best, length(p - q));
  return best;
}

struct ObstacleMemoryTest : testing::Test {
  Parameters parameters;
  ObstacleMemory memory{parameters};
  test::Shapes shapes;
  std::vector<Point> points;
};

TEST_F(ObstacleMemoryTest, EchoesStandWhereTheObstacleIsInTheRobotsFrame) {
  shapes.wall(2, -1, 2.2, 1);
  const Pose robot = {0.5, 0.2, 0.3};
  memory.see(robot, scan_from(shapes, robot, ms(100)));
  memory.points_from(robot, points);
  for (const double y : {-0.9, 0.0, 0.9}) EXPECT_LT(nearest(points, between(robot, {2, y, 0}).position()), 0.02);
  const Pose moved = {1.0, 0.0, -0.5};
  memory.points_from(moved, points);
  EXPECT_LT(nearest(points, between(moved, {2, 0, 0}).position()), 0.02);
}

TEST_F(ObstacleMemoryTest, RemembersObstaclesOutOfView) {
  shapes.wall(1, -0.5, 1.2, 0.5);
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(100)));
  const Pose turned = {0, 0, 3.0};
  memory.see(turned, scan_from(shapes, turned, ms(200)));
  EXPECT_GT(memory.remembered(), 10u);
  memory.points_from(turned, points);
  EXPECT_LT(nearest(points, between(turned, {1, 0, 0}).position()), 0.03);
}

TEST_F(ObstacleMemoryTest, ForgetsObstaclesThatBeamsPass) {
  shapes.discs.push_back({{1.5, 0}, 0.26});
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(100)));
  memory.see({0, 0, 3.0}, scan_from(shapes, {0, 0, 3.0}, ms(200)));
  EXPECT_GT(memory.remembered(), 5u);
  shapes.discs.clear();  // removed out of sight
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(300)));
  EXPECT_EQ(memory.remembered(), 0u);
}

TEST_F(ObstacleMemoryTest, KeepsHiddenObstacles) {
  shapes.wall(2, -0.3, 2.2, 0.3);
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(100)));
  shapes.discs.push_back({{1, 0}, 0.3});
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(200)));
  memory.points_from({0, 0, 0}, points);
  EXPECT_LT(nearest(points, {2, 0}), 0.05);
}

TEST_F(ObstacleMemoryTest, OldAndFarPointsAreForgotten) {
  shapes.wall(1, -0.5, 1.2, 0.5);
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(100)));
  memory.see({0, 0, 3.0}, scan_from(shapes, {0, 0, 3.0}, ms(200)));
  ASSERT_GT(memory.remembered(), 10u);
  memory.see({-4, 0, 3.0}, scan_from(shapes, {-4, 0, 3.0}, ms(300)));
  EXPECT_EQ(memory.remembered(), 0u);
  memory.see({0, 0, 0}, scan_from(shapes, {0, 0, 0}, ms(400)));
  memory.see({0, 0, 3.0}, scan_from(shapes, {0, 0, 3.0}, ms(500)));
  ASSERT_GT(memory.remembered(), 10u);
  const Time later = ms(500) + Duration::from_seconds(parameters.memory_age_s + 1);
  memory.see({0, 0, 3.0}, scan_from(shapes, {0, 0, 3.0}, later));
  EXPECT_EQ(memory.remembered(), 0u);
}

TEST(Route, PassesViaPointsNearByOrWhenBeyond) {
  Route route;
  const std::vector<Point> via = {{2, 0}, {4, 0}, {4, 3}};
  route.start({0, 0}, via);
  route.advance({1, 0}, 0.4);
  EXPECT_EQ(route.target(), via[0]);
  EXPECT_NEAR(route.remaining_m({1, 0}), 6, 1e-12);
  route.advance({1.7, 0}, 0.4);
  EXPECT_EQ(route.target(), via[1]);
  route.advance({4.1, 0.8}, 0.4);  // beyond it, though not near
  EXPECT_EQ(route.target(), via[2]);
  route.advance({4, 3.5}, 0.4);  // the last point is never passed
  EXPECT_TRUE(route.target_is_last());
  EXPECT_EQ(route.target(), via[2]);
}

TEST(Route, ACornerIsCutOnlyIfTheWayToTheNextPointIsClear) {
  Route route;
  const std::vector<Point> via = {{2, 0}, {2, 1}};
  std::vector<Point> asked;
  bool clear = false;
  const auto is_clear = [&](Point next) {
    asked.push_back(next);
    return clear;
  };
  route.start({0, 0}, via);
  route.advance({1.7, 0}, 0.4, is_clear);
  EXPECT_EQ(route.target(), via[0]);
  EXPECT_EQ(asked, std::vector<Point>({via[1]}));
  route.advance({1.85, 0}, 0.4, is_clear);  // as near as need be
  EXPECT_EQ(route.target(), via[1]);
  route.start({0, 0}, via);
  clear = true;
  route.advance({1.7, 0}, 0.4, is_clear);
  EXPECT_EQ(route.target(), via[1]);
}

TEST(ProgressWatch, WantsAStepInEverySpan) {
  ProgressWatch watch(0.2, Duration(std::chrono::seconds(5)));
  watch.start(ms(0));
  EXPECT_TRUE(watch.progressing(ms(100), 10));
  EXPECT_TRUE(watch.progressing(ms(5000), 9.9));
  EXPECT_TRUE(watch.progressing(ms(5050), 9.7));
  EXPECT_TRUE(watch.progressing(ms(10000), 9.75));
  EXPECT_FALSE(watch.progressing(ms(10100), 9.6));
}

}  // namespace
}  // namespace waitpoint::ndd
