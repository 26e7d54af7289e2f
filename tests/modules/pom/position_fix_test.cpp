// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/position_fix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "modules/pom/position_fusion.hpp"
#include "tests/modules/milliseconds.hpp"

namespace waitpoint::pom {
namespace {

using posters::Matrix3;

constexpr Matrix3 diagonal(double xx, double yy, double hh) { return {xx, 0, 0, 0, yy, 0, 0, 0, hh}; }
TEST(PositionFix, CountsByItsVarianceOnEachAxisAndLeavesTheHeading) {
  const UncertainPose prior = {{1, 2, 0.5}, diagonal(4, 1, 0.01)};
  const UncertainPose fused = fuse(prior, {{3, 3}, {}, 1, 0});
  EXPECT_NEAR(fused.pose.x, 1 + 2 * 4.0 / 5, 1e-12);
  EXPECT_NEAR(fused.pose.y, 2 + 1 * 1.0 / 2, 1e-12);
  EXPECT_EQ(fused.pose.heading, 0.5);
  EXPECT_NEAR(fused.covariance[0], 4.0 / 5, 1e-12);
  EXPECT_NEAR(fused.covariance[4], 1.0 / 2, 1e-12);
  EXPECT_NEAR(fused.covariance[8], 0.01, 1e-12);
  EXPECT_NEAR(disagreement(prior, {{3, 3}, {}, 1, 0}), 4.0 / 5 + 1.0 / 2, 1e-12);
}

TEST(PositionFix, IsThatOfTheAntenna) {
  const UncertainPose prior = {{0, 0, exact::pi / 2}, diagonal(100, 100, 0)};
  const PositionFix fix = {{10, 20}, {0.5, -0.25}, 1e-6, 0};  // the antenna is 0.25 m east and 0.5 m north of the robot
  for (const UncertainPose& there : {fuse(prior, fix), moved_to(prior, fix)}) {
    EXPECT_NEAR(there.pose.x, 9.75, 1e-5);
    EXPECT_NEAR(there.pose.y, 19.5, 1e-5);
    EXPECT_NEAR(there.pose.heading, exact::pi / 2, 1e-12);
  }
}

// A fix of an antenna a metre ahead, a little to the left: the robot turns, and its heading becomes more certain.
TEST(PositionFix, TurnsARobotWhoseAntennaIsBeside) {
  const UncertainPose prior = {{0, 0, 0}, diagonal(1e-6, 1e-6, 0.04)};
  const UncertainPose fused = fuse(prior, {{1, 0.1}, {1, 0}, 1e-4, 0});
  EXPECT_NEAR(fused.pose.heading, 0.1, 0.002);
  EXPECT_LT(fused.covariance[8], 2e-4);
}

posters::PositionEstimate driven(int tick, double heading) {
  const auto [s, c] = exact::sincos(heading);
  const double way_m = 0.01 * tick;
  return {ms(std::int64_t{20} * tick), {way_m * c, way_m * s, heading}, {}};
}

// The heading is unknown; the odometry goes east, the fixes go north.
TEST(PositionFix, TheWayBetweenFixesTellsTheHeading) {
  PositionFusion fusion({}, {{0, 0, 1.2}, diagonal(1, 1, 0.5)});
  const RandomStream noise(3, "test", "fix");
  for (int tick = 0; tick <= 2000; ++tick) {
    fusion.add_odometry(driven(tick, 0));
    if (tick % 50 != 0) continue;
    const auto n = static_cast<std::uint64_t>(tick);
    fusion.add_fix(1, ms(std::int64_t{20} * tick),
                   {{0.2 * noise.normal(n, 0), 0.01 * tick + 0.2 * noise.normal(n, 1)}, {}, 0.04, 0}, 13.82);
  }
  const posters::FusedPosition now = fusion.at(ms(40000));
  EXPECT_NEAR(now.position.pose.heading, exact::pi / 2, 0.05);
  EXPECT_NEAR(now.position.pose.y, 20, 0.2);
  EXPECT_EQ(now.state, posters::FusionState::good);
}

TEST(PositionFix, CommonErrorOfFixesDoesNotAverageOut) {
  UncertainPose pose = {{}, diagonal(100, 100, 0.01)};
  pose = fuse(pose, {{5, 5}, {}, 0.09, 0.25});
  EXPECT_NEAR(pose.pose.x, 5, 0.03) << "the first counts in full";
  for (int i = 0; i < 1000; ++i) pose = fuse(pose, {{5, 5}, {}, 0.09, 0.25});
  EXPECT_GE(pose.covariance[0], 0.25);
  EXPECT_GE(pose.covariance[4], 0.25);
  const UncertainPose sure = {{1, 1, 1}, diagonal(0.01, 0.04, 0.01)};
  EXPECT_EQ(fuse(sure, {{1.3, 1.3}, {}, 0.09, 0.25}).pose, sure.pose) << "nor does it disturb who is surer";
}

// Over many drives, with a receiver's drift: the covariance is not smaller than the errors.
TEST(PositionFix, TheFusionIsAsSureAsItIsRight) {
  constexpr double noise_m = 0.3, drift_m = 0.5, wheels_m = 0.02;
  double sum = 0;
  constexpr int drives = 200;
  for (std::uint64_t drive = 0; drive < drives; ++drive) {
    const RandomStream noise(drive, "test", "fix"), wheels(drive, "test", "wheels");
    const Point drift = {drift_m * noise.normal(1u << 30, 0), drift_m * noise.normal(1u << 30, 1)};
    PositionFusion fusion({}, {{}, diagonal(4, 4, 1e-4)});
    Point truth = {2 * noise.normal(1u << 31, 0), 2 * noise.normal(1u << 31, 1)};
    UncertainPose reckoned;
    for (std::uint64_t second = 0; second <= 60; ++second) {
      fusion.add_odometry({ms(static_cast<std::int64_t>(1000 * second)), reckoned.pose, reckoned.covariance});
      const Point error = {noise_m * noise.normal(second, 0), noise_m * noise.normal(second, 1)};
      fusion.add_fix(1, ms(static_cast<std::int64_t>(1000 * second)),
                     {truth + drift + error, {}, noise_m * noise_m, drift_m * drift_m}, 13.82);
      const Point step = {0.5 + wheels_m * wheels.normal(second, 0), wheels_m * wheels.normal(second, 1)};
      if (second == 60) break;
      truth = truth + step;
      reckoned = compose(reckoned, {{0.5, 0, 0}, diagonal(wheels_m * wheels_m, wheels_m * wheels_m, 1e-8)});
    }
    const posters::PositionEstimate now = fusion.at(ms(60000)).position;
    const Point off = now.pose.position() - truth;
    sum += off.x * off.x / now.covariance[0] + off.y * off.y / now.covariance[4];
  }
  EXPECT_GT(sum / drives, 0.7);
  EXPECT_LT(sum / drives, 2.4) << "2 would be exact";
}

TEST(PositionFix, WhenItComesMakesNoDifference) {
  const auto fused = [](bool late) {
    PositionFusion fusion({}, {{}, diagonal(1, 1, 0.1)});
    const auto fix = [&] { fusion.add_fix(1, ms(400), {{0.3, 0.1}, {0.1, 0}, 0.09, 0.01}, 13.82); };
    const auto place = [&] { fusion.add_absolute(0, {ms(800), {0.45, 0.02, 0.01}, diagonal(0.01, 0.01, 0.001)}); };
    for (int tick = 0; tick <= 60; ++tick) fusion.add_odometry(driven(tick, 0));
    late ? (place(), fix()) : (fix(), place());
    return fusion.at(ms(1200));
  };
  const posters::FusedPosition a = fused(false), b = fused(true);
  EXPECT_EQ(a.position.pose, b.position.pose);
  EXPECT_EQ(a.position.covariance, b.position.covariance);
}

TEST(PositionFix, ContradictoryFixIsRejectedAndReported) {
  PositionFusion fusion({}, {{}, diagonal(0.04, 0.04, 0.01)});
  for (int tick = 0; tick <= 60; ++tick) fusion.add_odometry(driven(tick, 0));
  const Pose before = fusion.at(ms(1200)).position.pose;
  fusion.add_fix(1, ms(1000), {{30, 0}, {}, 0.09, 0}, 13.82);
  EXPECT_EQ(fusion.at(ms(1200)).state, posters::FusionState::disagree);
  EXPECT_EQ(fusion.at(ms(1200)).position.pose, before);
}

}  // namespace
}  // namespace waitpoint::pom
