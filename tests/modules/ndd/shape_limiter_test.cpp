// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/shape_limiter.hpp"

#include <gtest/gtest.h>

#include <array>

namespace waitpoint::ndd {
namespace {

constexpr std::array<Point, 4> square = {{{0.21, 0.215}, {-0.21, 0.215}, {-0.21, -0.215}, {0.21, -0.215}}};

struct ShapeLimiterTest : testing::Test {
  ShapeLimiterTest() : footprint(square, 0.301), limiter(parameters, footprint) {}

  // Walls along the x axis, `aside_m` to both sides.
  static std::vector<Point> passage(double aside_m) {
    std::vector<Point> points;
    for (double x = -1; x <= 2; x += 0.02) points.push_back({x, aside_m}), points.push_back({x, -aside_m});
    return points;
  }

  Parameters parameters;
  Footprint footprint;
  ShapeLimiter limiter;
};

TEST_F(ShapeLimiterTest, DrivesThroughAPassageNarrowerThanTheDiscAboutTheRobot) {
  const Speeds speeds = limiter.limit({0.4, 0}, {0.4, 0}, passage(0.27));
  EXPECT_GT(speeds.v_m_s, 0.1);
  parameters.robot_radius_m = 0.301;
  EXPECT_EQ(SpeedLimiter(parameters).limit({0.4, 0}, {0.4, 0}, passage(0.27)).v_m_s, 0);
}

TEST_F(ShapeLimiterTest, DoesNotTurnOnTheSpotWhereACornerWouldTouch) {
  EXPECT_NE(limiter.limit({0, 0.5}, {}, passage(0.4)).w_rad_s, 0);
  const Speeds speeds = limiter.limit({0, 0.5}, {}, passage(0.25));
  EXPECT_LT(std::abs(speeds.w_rad_s), 0.3);
}

TEST_F(ShapeLimiterTest, BacksOutOfADeadEndInWhichItCannotTurn) {
  std::vector<Point> dead_end = passage(0.23);
  for (double y = -0.22; y <= 0.22; y += 0.02) dead_end.push_back({0.225, y});
  const Speeds speeds = limiter.limit({0.3, 0.5}, {}, dead_end);
  EXPECT_LT(speeds.v_m_s, 0);
  EXPECT_EQ(speeds.w_rad_s, 0);
  for (double y = -0.22; y <= 0.22; y += 0.02) dead_end.push_back({-0.225, y});
  EXPECT_EQ(limiter.limit({0.3, 0.5}, {}, dead_end).v_m_s, 0);
}

TEST_F(ShapeLimiterTest, StopsBeforeAWallInFrontOfIt) {
  for (const double gap_m : {0.05, 0.2, 0.5, 1.0}) {
    std::vector<Point> wall;
    for (double y = -1; y <= 1; y += 0.02) wall.push_back({0.21 + gap_m, y});
    const double v = limiter.limit({0.9, 0}, {0.3, 0}, wall).v_m_s;
    const double way_m = v > parameters.creep_m_s ? 0.5 * (gap_m - parameters.emergency_distance_m)
                                                  : gap_m - 0.5 * parameters.emergency_distance_m;
    EXPECT_LE(stopping_distance_m(parameters, v), way_m + 1e-9) << gap_m;
  }
}

}  // namespace
}  // namespace waitpoint::ndd
