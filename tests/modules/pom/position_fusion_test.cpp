// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/position_fusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "tests/modules/milliseconds.hpp"

namespace waitpoint::pom {
namespace {

using posters::Matrix3;

using posters::FusedPosition;
using posters::FusionState;
using posters::PositionEstimate;

constexpr double step_m = 0.01, step_rad = 0.004;  // every 20 ms
constexpr double step_deviation_m = 0.002, step_deviation_rad = 0.001;
constexpr double fix_deviation_m = 0.03, fix_deviation_rad = 0.01;

constexpr Matrix3 diagonal(double xy, double heading) {
  return {xy * xy, 0, 0, 0, xy * xy, 0, 0, 0, heading * heading};
}
Time tick(std::int64_t n) { return Time::from_ns(n * 20000000); }
// A drive on a circle: the truth, dead reckoning with its own covariance, and fixes on the truth.
struct Drive {
  std::vector<Pose> truth;
  std::vector<PositionEstimate> odometry, fixes;  // a fix every 15 ticks, with their dates

  Drive(std::uint64_t seed, int ticks) {
    const RandomStream noise(seed, "test", "odometry"), fix_noise(seed, "test", "fix");
    UncertainPose reckoned;
    Pose true_pose;
    for (int n = 0; n <= ticks; ++n) {
      truth.push_back(true_pose);
      odometry.push_back({tick(n), reckoned.pose, reckoned.covariance});
      const std::uint64_t k = static_cast<std::uint64_t>(n);
      if (n > 0 && n % 15 == 0) {
        const Pose fix = {true_pose.x + fix_deviation_m * fix_noise.normal(k, 0),
                          true_pose.y + fix_deviation_m * fix_noise.normal(k, 1),
                          exact::wrap_angle(true_pose.heading + fix_deviation_rad * fix_noise.normal(k, 2))};
        fixes.push_back({tick(n), fix, diagonal(fix_deviation_m, fix_deviation_rad)});
      }
      const Pose step = {step_m, 0, step_rad};
      true_pose = waitpoint::compose(true_pose, step);
      const Pose measured = {step.x + step_deviation_m * noise.normal(k, 0), step_deviation_m * noise.normal(k, 1),
                             step.heading + step_deviation_rad * noise.normal(k, 2)};
      reckoned = compose(reckoned, {measured, diagonal(step_deviation_m, step_deviation_rad)});
    }
  }
};

UncertainPose start() { return {{}, diagonal(0.001, 0.001)}; }

void expect_same(const FusedPosition& a, const FusedPosition& b) {
  EXPECT_EQ(a.position.pose, b.position.pose);
  EXPECT_EQ(a.position.covariance, b.position.covariance);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.correction_age, b.correction_age);
}

FusedPosition in_order(const Drive& drive) {
  PositionFusion fusion({}, start());
  std::size_t next = 0;
  for (const PositionEstimate& o : drive.odometry) {
    fusion.add_odometry(o);
    if (next < drive.fixes.size() && drive.fixes[next].date <= o.date) fusion.add_absolute(0, drive.fixes[next++]);
  }
  return fusion.at(drive.odometry.back().date);
}

TEST(PositionFusion, LatePositionsGiveTheVeryResultOfPunctualOnes) {
  const Drive drive(1, 300);
  PositionFusion fusion({}, start());
  for (std::size_t n = 0; n < drive.odometry.size(); ++n) {
    fusion.add_odometry(drive.odometry[n]);
    for (const PositionEstimate& fix : drive.fixes)  // 23 ticks late
      if (fix.date + Duration(std::chrono::milliseconds(460)) == drive.odometry[n].date) fusion.add_absolute(0, fix);
  }
  for (const PositionEstimate& fix : drive.fixes)
    if (fix.date + Duration(std::chrono::milliseconds(460)) > drive.odometry.back().date) fusion.add_absolute(0, fix);
  expect_same(fusion.at(drive.odometry.back().date), in_order(drive));
}

TEST(PositionFusion, OrderOfArrivalDoesNotMatter) {
  const Drive drive(2, 300);
  PositionFusion backwards({}, start()), fixes_first({}, start());
  for (const PositionEstimate& o : drive.odometry) backwards.add_odometry(o);
  for (std::size_t i = drive.fixes.size(); i-- > 0;) backwards.add_absolute(0, drive.fixes[i]);
  for (const PositionEstimate& fix : drive.fixes) fixes_first.add_absolute(0, fix);
  for (const PositionEstimate& o : drive.odometry) fixes_first.add_odometry(o);
  const FusedPosition expected = in_order(drive);
  expect_same(backwards.at(drive.odometry.back().date), expected);
  expect_same(fixes_first.at(drive.odometry.back().date), expected);
}

TEST(PositionFusion, OdometryOutOfOrderGivesTheSameResult) {
  const Drive drive(3, 120);
  PositionFusion fusion({}, start());
  fusion.add_odometry(drive.odometry[0]);
  for (std::size_t n = 1; n + 1 < drive.odometry.size(); n += 2) {
    fusion.add_odometry(drive.odometry[n + 1]);
    for (const PositionEstimate& fix : drive.fixes)
      if (fix.date == drive.odometry[n].date || fix.date == drive.odometry[n + 1].date) fusion.add_absolute(0, fix);
    fusion.add_odometry(drive.odometry[n]);
  }
  expect_same(fusion.at(drive.odometry.back().date), in_order(drive));
}

TEST(PositionFusion, LatePositionIsComposedWithTheMotionSince) {
  FusionParameters parameters;
  PositionFusion fusion(parameters, {{0, 0, 0}, diagonal(100, 10)});
  fusion.add_odometry({ms(0), {5, 5, 0}, {}});
  fusion.add_odometry({ms(100), {6, 5, exact::pi / 2}, {}});
  fusion.add_odometry({ms(200), {6, 7, exact::pi / 2}, {}});
  fusion.add_absolute(0, {ms(100), {10, 20, exact::pi}, diagonal(1e-4, 1e-4)});
  const Pose now = fusion.at(ms(200)).position.pose;
  EXPECT_NEAR(now.x, 8, 1e-3);
  EXPECT_NEAR(now.y, 20, 1e-3);
  EXPECT_NEAR(std::fabs(now.heading), exact::pi, 1e-6);
  EXPECT_EQ(fusion.at(ms(200)).correction_age, Duration(std::chrono::milliseconds(100)));
}

TEST(PositionFusion, ErrorsAreAsLargeAsTheCovarianceSays) {
  constexpr int drives = 400;
  double nees = 0, error = 0;
  for (std::uint64_t seed = 0; seed < drives; ++seed) {
    const Drive drive(100 + seed, 157);
    const RandomStream start_noise(seed, "test", "start");
    UncertainPose known = start();
    known.pose = {0.001 * start_noise.normal(0, 0), 0.001 * start_noise.normal(0, 1), 0.001 * start_noise.normal(0, 2)};
    FusionParameters parameters;
    parameters.shared_errors = false;  // the fixes have an independent source
    PositionFusion fusion(parameters, known);
    for (const PositionEstimate& o : drive.odometry) fusion.add_odometry(o);
    for (const PositionEstimate& fix : drive.fixes) fusion.add_absolute(0, fix);
    const PositionEstimate fused = fusion.at(drive.odometry.back().date).position;
    nees += disagreement(UncertainPose{fused.pose, fused.covariance}, UncertainPose{drive.truth.back(), {}}) / drives;
    error += length(fused.pose.position() - drive.truth.back().position()) / drives;
  }
  EXPECT_NEAR(nees, 3, 0.35);
  EXPECT_LT(error, fix_deviation_m);  // better than a single fix, long after the odometry alone is worse
}

TEST(PositionFusion, CovarianceOfTheMotionIsTurnedIntoTheReferenceFrame) {
  // Odometry moves along its own x axis and is uncertain across it; the robot truly faces along y.
  FusionParameters parameters;
  PositionFusion fusion(parameters, {{0, 0, exact::pi / 2}, {}});
  fusion.add_odometry({ms(0), {0, 0, 0}, {}});
  fusion.add_odometry({ms(1000), {1, 0, 0}, {0, 0, 0, 0, 0.04, 0, 0, 0, 0}});
  const PositionEstimate fused = fusion.at(ms(1000)).position;
  EXPECT_NEAR(fused.pose.y, 1, 1e-12);
  EXPECT_NEAR(fused.covariance[0], 0.04, 1e-12);
  EXPECT_NEAR(fused.covariance[4], 0, 1e-12);
}

TEST(PositionFusion, PositionOutsideTheGateIsLeftOutAndReported) {
  const Drive drive(4, 100);
  PositionFusion with({}, start()), without({}, start());
  for (const PositionEstimate& o : drive.odometry) with.add_odometry(o), without.add_odometry(o);
  PositionEstimate wrong = drive.fixes[2];
  wrong.pose.x += 1;
  with.add_absolute(0, drive.fixes[0]), without.add_absolute(0, drive.fixes[0]);
  with.add_absolute(0, wrong);
  const FusedPosition fused = with.at(tick(100));
  EXPECT_EQ(fused.state, FusionState::disagree);
  EXPECT_EQ(fused.correction_age, tick(100) - drive.fixes[0].date);
  EXPECT_LT(length(fused.position.pose.position() - without.at(tick(100)).position.pose.position()), 1e-9);
  with.add_absolute(0, drive.fixes[4]);
  EXPECT_NE(with.at(tick(100)).state, FusionState::disagree);
}

TEST(PositionFusion, SourcesAreSwitchedWhileItRuns) {
  const Drive drive(5, 100);
  PositionFusion fusion({}, start());
  for (const PositionEstimate& o : drive.odometry) fusion.add_odometry(o);
  PositionEstimate wrong = drive.fixes[1];
  wrong.pose.y -= 2;
  fusion.add_absolute(0, drive.fixes[0]);
  fusion.add_absolute(1, wrong);
  EXPECT_EQ(fusion.at(tick(100)).state, FusionState::disagree);
  fusion.set_source(1, false);
  EXPECT_EQ(fusion.at(tick(100)).state, FusionState::good);
  fusion.add_absolute(1, wrong);
  EXPECT_EQ(fusion.at(tick(100)).state, FusionState::good);
  fusion.set_source(1, true);
  wrong.date = drive.fixes[2].date;
  fusion.add_absolute(1, wrong);
  EXPECT_EQ(fusion.at(tick(100)).state, FusionState::disagree);
}

TEST(PositionFusion, UncertainAboveTheBoundAndGoodAgainAfterACorrection) {
  FusionParameters parameters;
  parameters.uncertain_m = 0.02;
  const Drive drive(6, 400);
  PositionFusion fusion(parameters, start());
  for (std::size_t n = 0; n < 4; ++n) fusion.add_odometry(drive.odometry[n]);
  EXPECT_EQ(fusion.at(tick(3)).state, FusionState::good);
  EXPECT_EQ(fusion.at(tick(3)).correction_age, Duration::max());
  for (std::size_t n = 4; n < drive.odometry.size(); ++n) fusion.add_odometry(drive.odometry[n]);
  EXPECT_EQ(fusion.at(tick(400)).state, FusionState::uncertain);
  PositionEstimate sure = {tick(400), drive.truth[400], diagonal(0.005, 0.005)};
  fusion.add_absolute(0, sure);
  EXPECT_EQ(fusion.at(tick(400)).state, FusionState::good);
}

TEST(PositionFusion, RunsOnForLongerThanItsBuffers) {
  const int ticks = 3 * static_cast<int>(PositionFusion::odometry_count_max);
  const Drive drive(7, ticks);
  PositionFusion fusion({}, start()), reckoning({}, start());
  std::size_t next = 0;
  double worst = 0;
  for (std::size_t n = 0; n < drive.odometry.size(); ++n) {
    fusion.add_odometry(drive.odometry[n]);
    reckoning.add_odometry(drive.odometry[n]);
    if (n > 10 && next < drive.fixes.size() && drive.fixes[next].date <= drive.odometry[n - 10].date)
      fusion.add_absolute(0, drive.fixes[next++]);
    const Pose pose = fusion.at(drive.odometry[n].date).position.pose;
    worst = std::max(worst, length(pose.position() - drive.truth[n].position()));
  }
  EXPECT_LT(worst, 0.15);
  EXPECT_EQ(fusion.late(), 0u);
  const PositionEstimate end = reckoning.at(drive.odometry.back().date).position, raw = drive.odometry.back();
  EXPECT_NEAR(end.pose.x, raw.pose.x, 1e-9);
  EXPECT_NEAR(end.covariance[0] / raw.covariance[0], 1, 0.01);
  fusion.add_absolute(0, drive.fixes.front());
  EXPECT_EQ(fusion.late(), 1u);
}

TEST(PositionFusion, MostReliableStandsAlone) {
  FusionParameters parameters;
  parameters.kalman = false;
  PositionFusion fusion(parameters, {{}, diagonal(0.05, 0.01)});
  fusion.add_odometry({ms(0), {}, {}});
  fusion.add_odometry({ms(100), {}, {}});
  fusion.add_absolute(0, {ms(50), {0.1, 0, 0}, diagonal(0.2, 0.01)});
  EXPECT_EQ(fusion.at(ms(100)).position.pose.x, 0);
  fusion.add_absolute(0, {ms(60), {0.02, 0, 0}, diagonal(0.01, 0.01)});
  EXPECT_NEAR(fusion.at(ms(100)).position.pose.x, 0.02, 1e-12);
}

}  // namespace
}  // namespace waitpoint::pom
