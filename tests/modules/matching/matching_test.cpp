// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "modules/matching/correlative_search.hpp"
#include "modules/matching/refinement.hpp"

namespace waitpoint::matching {
namespace {

// Points every 5 cm of a wall from a to b, seen from its left.
void wall(std::vector<SurfacePoint>& points, Point a, Point b) {
  const double all = length(b - a);
  const Point along = (1 / all) * (b - a);
  for (double way = 0; way < all; way += 0.05) points.push_back({a + way * along, {-along.y, along.x}});
}

// A room of 8 m x 5 m with a niche, seen from inside.
std::vector<SurfacePoint> room() {
  std::vector<SurfacePoint> points;
  wall(points, {0, 0}, {8, 0});
  wall(points, {8, 0}, {8, 5});
  wall(points, {8, 5}, {5, 5});
  wall(points, {5, 5}, {5, 6});
  wall(points, {5, 6}, {3.5, 6});
  wall(points, {3.5, 6}, {3.5, 5});
  wall(points, {3.5, 5}, {0, 5});
  wall(points, {0, 5}, {0, 0});
  return points;
}

std::vector<SurfacePoint> seen_from(const Pose& robot, std::vector<SurfacePoint> points) {
  const Pose back = between(robot, {});
  for (SurfacePoint& p : points) p = {transform(back, p.position), transform({0, 0, back.heading}, p.normal)};
  return points;
}

SurfaceMap map_of(const std::vector<SurfacePoint>& points) {
  SurfaceMap map(0.05, 0.3, 0.07);
  map.add({}, points);
  return map;
}

TEST(Surface, NormalOfAWallPointsToTheObserver) {
  posters::Echoes echoes;
  echoes.mount = {0.1, 0, 0};
  echoes.scan.first_angle_rad = -0.5;
  echoes.scan.angle_step_rad = 0.01;
  echoes.scan.range_max_m = 30;
  echoes.scan.range_m.resize(101);
  for (std::uint32_t i = 0; i <= 100; ++i) echoes.scan.range_m[i] = static_cast<float>(2 / exact::cos(-0.5 + 0.01 * i));
  std::vector<SurfacePoint> points;
  surface_of(echoes, {}, points);
  ASSERT_GT(points.size(), 20u);
  for (const SurfacePoint& p : points) {
    EXPECT_NEAR(p.position.x, 2.1, 1e-6);
    EXPECT_NEAR(p.normal.x, -1, 1e-3);
  }
}

TEST(Refinement, FindsThePoseOfAScanWithinAMillimetre) {
  const SurfaceMap map = map_of(room());
  const Pose truth{2.5, 2, 0.4};
  const Refined found = refine(map, seen_from(truth, room()), {2.6, 1.92, 0.44}, {}, {});
  EXPECT_NEAR(found.pose.x, truth.x, 1e-3);
  EXPECT_NEAR(found.pose.y, truth.y, 1e-3);
  EXPECT_NEAR(found.pose.heading, truth.heading, 1e-3);
  EXPECT_GT(found.explained, 0.98);
}

// A partition whose sides are nearer to each other than a cell is wide.
TEST(Refinement, AThinWallExplainsWhatIsSeenOfEitherSide) {
  std::vector<SurfacePoint> both;
  wall(both, {0, 0}, {6, 0});
  wall(both, {6, -0.03}, {0, -0.03});
  wall(both, {6, -3}, {6, 3});
  const SurfaceMap map = map_of(both);
  for (const bool above : {true, false}) {
    std::vector<SurfacePoint> side;
    above ? wall(side, {0, 0}, {6, 0}) : wall(side, {6, -0.03}, {0, -0.03});
    wall(side, {6, above ? 0.0 : -3.0}, {6, above ? 3.0 : 0.0});
    const Pose robot{3, above ? 1.0 : -1.0, 0.3};
    const Refined found = refine(map, seen_from(robot, side), compose(robot, {0, 0.02, 0}), {}, {});
    EXPECT_GT(found.explained, 0.98);
    EXPECT_NEAR(found.pose.y, robot.y, 0.002);
  }
}

TEST(Refinement, AlongACorridorThePriorDecides) {
  std::vector<SurfacePoint> corridor;
  wall(corridor, {0, 0}, {20, 0});
  wall(corridor, {20, 2}, {0, 2});
  const SurfaceMap map = map_of(corridor);
  std::vector<SurfacePoint> scan;
  wall(scan, {5, 0}, {15, 0});
  wall(scan, {15, 2}, {5, 2});
  const Pose truth{10, 1, 0};
  const Refined found = refine(map, seen_from(truth, scan), {10.1, 1.1, 0.03}, {100, 0, 0, 0, 100, 0, 0, 0, 100}, {});
  EXPECT_NEAR(found.pose.x, 10.1, 0.02);
  EXPECT_NEAR(found.pose.y, 1, 2e-3);
  EXPECT_LT(found.information[0], 0.01 * found.information[4]);
}

TEST(CorrelativeSearch, FindsThePoseFromAnywhereInTheRoom) {
  const SurfaceMap map = map_of(room());
  const ScorePyramid pyramid(map, 6);
  const Pose truth{5.5, 3, -2.2};
  const auto peaks = search(pyramid, seen_from(truth, room()), {{4, 3, 0}, 6, 6, exact::pi}, {});
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].pose.x, truth.x, 0.06);
  EXPECT_NEAR(peaks[0].pose.y, truth.y, 0.06);
  EXPECT_NEAR(exact::wrap_angle(peaks[0].pose.heading - truth.heading), 0, 0.02);
}

TEST(CorrelativeSearch, TellsThatASymmetricRoomFitsTwice) {
  std::vector<SurfacePoint> plain;
  wall(plain, {0, 0}, {8, 0});
  wall(plain, {8, 0}, {8, 5});
  wall(plain, {8, 5}, {0, 5});
  wall(plain, {0, 5}, {0, 0});
  const SurfaceMap map = map_of(plain);
  const auto peaks = search(ScorePyramid(map, 6), seen_from({5.5, 3, -2.2}, plain), {{4, 3, 0}, 6, 6, exact::pi}, {});
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_NEAR(std::fabs(exact::wrap_angle(peaks[0].pose.heading - peaks[1].pose.heading)), exact::pi, 0.03);
}

TEST(CorrelativeSearch, FindsNothingWhereTheScanIsNotFrom) {
  std::vector<SurfacePoint> other;
  wall(other, {0, 0}, {3, 1});
  wall(other, {3, 1}, {2, 4});
  wall(other, {2, 4}, {-1, 3});
  const SurfaceMap map = map_of(room());
  EXPECT_TRUE(search(ScorePyramid(map, 6), other, {{4, 3, 0}, 6, 6, exact::pi}, {.score_min = 0.7}).empty());
}

// The bound of a block is that of all poses in it: the best pose is the same with and without blocks.
TEST(CorrelativeSearch, BlocksLoseNoPose) {
  const SurfaceMap map = map_of(room());
  for (const double heading : {0.0, 0.7, 2.9}) {
    const auto scan = seen_from({3, 2, heading}, room());
    const SearchWindow window{{3.3, 1.8, heading + 0.05}, 0.6, 0.6, 0.1};
    const auto plain = search(ScorePyramid(map, 1), scan, window, {.peaks_max = 1});
    const auto blocks = search(ScorePyramid(map, 6), scan, window, {.peaks_max = 1});
    ASSERT_EQ(plain.size(), 1u);
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(plain[0].score, blocks[0].score);
  }
}

}  // namespace
}  // namespace waitpoint::matching
