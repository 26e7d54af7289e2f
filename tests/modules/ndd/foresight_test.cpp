// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/foresight.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace waitpoint::ndd {
namespace {

struct ForesightTest : testing::Test {
  ForesightTest() { parameters.foresight_s = 2; }

  // The least distance between hull and disc, if the base takes up the speeds at once and drives straight on.
  double least_gap_m(const Speeds& speeds, const Foresight::Disc& disc) const {
    double least_m = 100;
    for (double t = 0; t <= 2; t += 0.02) {
      const double turn = speeds.w_rad_s * std::min(t, 0.5);
      const exact::SinCos facing = exact::sincos(turn);
      const Point at = {speeds.v_m_s * t * facing.cos, speeds.v_m_s * t * facing.sin};
      const Point other = disc.centre + t * disc.velocity;
      least_m = std::min(least_m, length(other - at) - parameters.robot_radius_m - disc.radius_m);
    }
    return least_m;
  }

  Speeds choose(const Speeds& wanted, const Speeds& measured, const Foresight::Disc& disc,
                std::span<const Point> points = {}) const {
    return Foresight(parameters, Footprint(parameters.robot_radius_m)).choose(wanted, measured, {&disc, 1}, points);
  }

  Parameters parameters;
};

TEST_F(ForesightTest, WantedSpeedsAreKeptIfNothingComesNear) {
  const Foresight::Disc leaving = {{2, 1}, {0.5, 1}, 0.2};
  const Speeds speeds = choose({0.7, 0.2}, {0.7, 0.2}, leaving);
  EXPECT_EQ(speeds.v_m_s, 0.7);
  EXPECT_EQ(speeds.w_rad_s, 0.2);
}

TEST_F(ForesightTest, LetsACrossingObstaclePass) {
  const Foresight::Disc crossing = {{1.2, -1.2}, {0, 0.9}, 0.2};
  const Speeds wanted = {0.9, 0};
  EXPECT_LT(least_gap_m(wanted, crossing), 0);
  const Speeds speeds = choose(wanted, wanted, crossing);
  EXPECT_GT(least_gap_m(speeds, crossing), 0);
}

TEST_F(ForesightTest, ARobotThatStandsGetsOutOfTheWay) {
  const Foresight::Disc coming = {{1.5, 0}, {-0.8, 0}, 0.2};
  const Speeds speeds = choose({}, {}, coming);
  EXPECT_NE(speeds.v_m_s, 0);
}

TEST_F(ForesightTest, DoesNotBackIntoAWall) {
  const Foresight::Disc coming = {{1.5, 0}, {-0.8, 0}, 0.2};
  std::vector<Point> wall;
  for (double y = -2; y <= 2; y += 0.05) wall.push_back({-0.32, y});
  const Speeds speeds = choose({}, {}, coming, wall);
  EXPECT_GE(speeds.v_m_s, 0);
}

}  // namespace
}  // namespace waitpoint::ndd
