// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/motion_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "modules/ndd/bypass.hpp"

namespace waitpoint::ndd {
namespace {

const Parameters parameters;

std::vector<Point> wall_ahead(double hull_distance) {
  std::vector<Point> points;
  for (double y = -2; y <= 2; y += 0.02) points.push_back({parameters.robot_radius_m + hull_distance, y});
  return points;
}

TEST(MotionLaw, DrivesTheSlowerTheFartherItMustTurn) {
  EXPECT_NEAR(motion_law(parameters, 0, 1, 9).v_m_s, parameters.v_m_s_max, 1e-12);
  EXPECT_NEAR(motion_law(parameters, exact::pi / 4, 1, 9).v_m_s, 0.5 * parameters.v_m_s_max, 1e-12);
  EXPECT_EQ(motion_law(parameters, exact::pi / 2, 1, 9).v_m_s, 0);
  EXPECT_EQ(motion_law(parameters, exact::pi / 2, 1, 9).w_rad_s, parameters.w_rad_s_max);
  EXPECT_EQ(motion_law(parameters, -exact::pi / 2, 1, 9).w_rad_s, -parameters.w_rad_s_max);
  EXPECT_NEAR(motion_law(parameters, 0, 0.5, 9).v_m_s, 0.5 * parameters.v_m_s_max, 1e-12);
  EXPECT_EQ(motion_law(parameters, 0, 1, 0.2).v_m_s, 0.2);
}

TEST(SpeedLimiter, StopsInHalfTheFreeDistance) {
  SpeedLimiter limiter(parameters);
  for (const double free : {0.1, 0.3, 0.6, 1.0, 3.0}) {
    const double v = limiter.limit({0.9, 0}, {}, wall_ahead(free)).v_m_s;
    const double stop = v * parameters.reaction_s + v * v / (2 * parameters.braking_m_s2);
    if (v > parameters.creep_m_s) {
      EXPECT_LE(stop, 0.5 * (free - parameters.emergency_distance_m) + 1e-9);
    }
    if (free >= 2) {
      EXPECT_EQ(v, 0.9);
    }
  }
}

TEST(SpeedLimiter, StandsAtTheEmergencyDistanceButMayTurn) {
  SpeedLimiter limiter(parameters);
  const Speeds speeds = limiter.limit({0.9, 1.0}, {}, wall_ahead(0.5 * parameters.emergency_distance_m));
  EXPECT_EQ(speeds.v_m_s, 0);
  EXPECT_EQ(speeds.w_rad_s, 1.0);
}

TEST(SpeedLimiter, IgnoresObstaclesBehind) {
  SpeedLimiter limiter(parameters);
  EXPECT_EQ(limiter.limit({0.9, 0}, {}, std::vector<Point>{{-0.28, 0}, {-0.1, 0.27}}).v_m_s, 0.9);
}

// Two discs under the limiter, driven at random towards each other; each sees the other a scan late, and brakes within
// the limits of a base.
TEST(SpeedLimiter, TwoRobotsUnderItNeverMeet) {
  SpeedLimiter limiter(parameters);
  const double radius = parameters.robot_radius_m;
  double least = 10;
  for (std::uint64_t meeting = 0; meeting < 150; ++meeting) {
    const RandomStream random(meeting, "test", "meeting");
    Pose pose[2], seen[2];
    double v[2] = {}, w[2] = {};
    Speeds command[2];
    pose[0] = {0, 0, 0.3 * random.normal(0, 0)};
    pose[1] = {3, random.normal(0, 1), exact::pi + 0.3 * random.normal(0, 2)};
    for (int step = 0; step < 1200; ++step) {
      for (int i = 0; i < 2; ++i) {
        v[i] += std::clamp(command[i].v_m_s - v[i], -0.01, 0.01);
        w[i] += std::clamp(command[i].w_rad_s - w[i], -0.03, 0.03);
        const auto [s, c] = exact::sincos(pose[i].heading);
        pose[i] = {pose[i].x + 0.01 * v[i] * c, pose[i].y + 0.01 * v[i] * s,
                   exact::wrap_angle(pose[i].heading + 0.01 * w[i])};
      }
      least = std::min(least, length(pose[0].position() - pose[1].position()) - 2 * radius);
      for (int i = 0; i < 2; ++i) {
        if (step % 10 == 5 * i) seen[i] = pose[1 - i];
        if (step % 10 != (5 * i + 7) % 10) continue;
        std::vector<Point> points;
        for (int k = 0; k < 90; ++k) {
          const auto [s, c] = exact::sincos(k * exact::pi / 45);
          points.push_back(between(pose[i], {seen[i].x + radius * c, seen[i].y + radius * s, 0}).position());
        }
        const Point other = between(pose[i], seen[i]).position();
        const double direction = exact::atan2(other.y, other.x) + random.normal(static_cast<std::uint64_t>(step), 3);
        command[i] =
            limiter.limit({0.9, std::clamp(2 * exact::wrap_angle(direction), -1.5, 1.5)}, {v[i], w[i]}, points);
      }
    }
  }
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 0.2);  // they did get close
}

TEST(Bypass, ClearWayIsKept) {
  Bypass bypass(parameters);
  Diagram diagram;
  diagram.build(std::vector<Point>{{1, 0.5}, {1, -0.5}}, 8);
  EXPECT_EQ(bypass.clear(diagram, 0, 2), 0);
}

TEST(Bypass, PassesARobotAheadOnTheRightWithClearance) {
  Bypass bypass(parameters);
  std::vector<Point> points;
  for (int k = 0; k < 90; ++k) {
    const auto [s, c] = exact::sincos(k * exact::pi / 45);
    points.push_back({1.5 + 0.26 * c, 0.26 * s});
  }
  Diagram diagram;
  diagram.build(points, 8);
  const double direction = bypass.clear(diagram, 0, 2);
  EXPECT_LT(direction, 0);
  const auto [s, c] = exact::sincos(direction);
  EXPECT_GE(std::fabs(cross({c, s}, {1.5, 0})), 2 * 0.26 + parameters.bypass_clearance_m - 0.02);
  EXPECT_EQ(bypass.clear(diagram, 0, 1.0), 0);  // beyond the range considered
}

TEST(Bypass, GivesUpClearanceWhereThePassageIsNarrow) {
  Bypass bypass(parameters);
  std::vector<Point> points;
  for (double y = 0.32; y < 3; y += 0.02) points.push_back({0.8, y}), points.push_back({0.8, -y});
  Diagram diagram;
  diagram.build(points, 8);
  EXPECT_NEAR(bypass.clear(diagram, 0.05, 2), 0, 0.06);
}

}  // namespace
}  // namespace waitpoint::ndd
