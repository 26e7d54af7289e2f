// SPDX-License-Identifier: BSD-3-Clause
// What is fitted to a log of known errors is these errors.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/fit/known_errors.hpp"
#include "tests/tools/folder.hpp"
#include "tools/fit/laser_fit.hpp"
#include "tools/fit/odometry_fit.hpp"
#include "tools/fit/robot_type.hpp"

namespace waitpoint::tools {
namespace {

TEST(Fit, TheErrorsOfTheOdometryAreFoundAlsoBehindTheNoiseOfLocalisation) {
  const OdometryFit errors{.travel_scale = 1.02,
                           .turn_scale = 0.98,
                           .drift_rad_per_m = 0.004,
                           .travel_noise_m_per_sqrt_m = 0.02,
                           .turn_noise_rad_per_sqrt_m = 0.01,
                           .turn_noise_rad_per_sqrt_rad = 0};
  const Drive drive(2000, errors, 0.01);
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised, "drive.log");
  EXPECT_NEAR(fit.travel_scale, errors.travel_scale, 0.003);
  EXPECT_NEAR(fit.turn_scale, errors.turn_scale, 0.003);
  EXPECT_NEAR(fit.drift_rad_per_m, errors.drift_rad_per_m, 0.001);
  EXPECT_NEAR(fit.travel_noise_m_per_sqrt_m, errors.travel_noise_m_per_sqrt_m, 0.004);
  EXPECT_NEAR(fit.turn_noise_rad_per_sqrt_m, errors.turn_noise_rad_per_sqrt_m, 0.003);
  EXPECT_GT(fit.stretches, 2000u);
}

TEST(Fit, ExactOdometryHasNoErrorsWhateverTheNoiseOfLocalisation) {
  const Drive drive(500, {}, 0.01);
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised, "drive.log");
  EXPECT_NEAR(fit.travel_scale, 1, 0.003);
  EXPECT_NEAR(fit.turn_scale, 1, 1e-6);
  EXPECT_LT(fit.travel_noise_m_per_sqrt_m, 0.008);
  EXPECT_LT(fit.turn_noise_rad_per_sqrt_m, 1e-6);
}

TEST(Fit, AJumpOfTheLocalisationIsAnOutlier) {
  const OdometryFit errors{.turn_noise_rad_per_sqrt_m = 0.01};
  Drive drive(1000, errors, 0);
  const Pose jump{1, 2, 0.8};
  for (std::size_t i = drive.localised.size() / 2; i < drive.localised.size(); ++i)
    drive.localised[i] = compose(jump, drive.localised[i]);
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised, "drive.log");
  EXPECT_GT(fit.left_out, 0u);
  EXPECT_NEAR(fit.turn_noise_rad_per_sqrt_m, 0.01, 0.003);
}

std::string refusal(const Drive& drive) {
  try {
    fit_odometry(drive.measured, drive.localised, "drive.log");
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Fit, AShortLogIsRefusedByItsName) {
  EXPECT_EQ(refusal(Drive(30, {}, 0)).substr(0, 36), "drive.log: expected at least 40 m of");
}

// As of a robot that sees nothing: its localisation predicts by the odometry.
TEST(Fit, ALogWhoseScansCorrectNothingIsRefused) {
  Drive drive(200, {.travel_scale = 1.1}, 0.01);
  drive.localised = drive.measured;
  EXPECT_NE(refusal(drive).find("the localisation stood still, or saw nothing"), std::string::npos);
}

TEST(Fit, StretchesThatWereNotCorrectedAreLeftOutAndCounted) {
  Drive drive(400, {.travel_scale = 1.1}, 0.01);
  for (std::size_t i = drive.measured.size() / 2; i < drive.measured.size(); ++i)
    drive.localised[i] = compose(drive.localised[i - 1], between(drive.measured[i - 1], drive.measured[i]));
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised, "drive.log");
  EXPECT_GT(fit.uncorrected, 300u);
  EXPECT_NEAR(fit.travel_scale, 1.1, 0.005);
}

TEST(Fit, TheScaleOfTurnsThatAStraightLogDoesNotShowStays1) {
  Drive drive(200, {}, 0);
  RandomStream random(2, "straight", "noise");
  for (std::size_t i = 0; i < drive.measured.size(); ++i) {
    drive.localised[i] = {0.1 * static_cast<double>(i), 0.003 * random.normal(2 * i), 0.002 * random.normal(2 * i + 1)};
    drive.measured[i] = {0.102 * static_cast<double>(i), 0, 0};
  }
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised, "drive.log");
  EXPECT_FALSE(fit.turns_seen);
  EXPECT_EQ(fit.turn_scale, 1);
  EXPECT_NEAR(fit.travel_scale, 1.02, 0.003);
  const std::string text = robot_type_text({.name = "straight", .odometry = fit});
  EXPECT_NE(text.find("too few turns to show their scale"), std::string::npos);
}

TEST(Fit, TheLasersNoiseResolutionDropoutsAndTimesAreFound) {
  const LaserFit fit = fit_laser(scans_at_rest(0.007, 0.01, 0.02));
  EXPECT_EQ(fit.resolution_m, 0.01);
  EXPECT_NEAR(fit.range_noise_m, 0.007, 0.0005);
  EXPECT_NEAR(fit.dropout, 0.02, 0.005);
  EXPECT_NEAR(fit.period_s, 0.1, 0.001);
  EXPECT_NEAR(fit.jitter_s, 0.002 * std::sqrt(2.0), 0.0006);
  EXPECT_EQ(fit.missing, 1u);
  EXPECT_NEAR(fit.field_of_view_rad, 2, 1e-9);
}

// As many as a simulated laser can have.
TEST(Fit, UsesEveryNthOfManyBeams) {
  logs::SensorLog log = scans_at_rest(0.007, 0.01, 0);
  for (logs::LoggedScan& scan : log.scans) {
    scan.range_m.resize(1081, 3);
    scan.angle_step_rad = exact::pi / 720;
  }
  const LaserFit fit = fit_laser(log);
  EXPECT_EQ(fit.beams, 541u);
  EXPECT_NEAR(fit.field_of_view_rad, 1.5 * exact::pi, 1e-9);
  EXPECT_NE(robot_type_text({.name = "many", .laser = fit}).find("One beam in 2 of the log's"), std::string::npos);
  for (logs::LoggedScan& scan : log.scans) scan.range_m.resize(1);
  EXPECT_THROW(fit_laser(log), BadInput);
}

// The shipped robot has the errors of scenarios/rackham.yaml.
TEST(Fit, TheRobotTypeOfARecordedRunHasItsErrorsAndIsAccepted) {
  const Folder folder;
  const std::string log = (folder / "run.log").string(), out = (folder / "fitted.yaml").string();
  ASSERT_EQ(runs::outcome_of(runs::run_command("office.yaml", "200", {"--record", log})).status, 1);  // goals left
  const runs::Outcome fitted =
      runs::outcome_of({.words = {runs::program().string(), "fit", log, "--name", "like", "--out", out}});
  ASSERT_EQ(fitted.status, 0) << fitted.errors;
  const std::string text = folder.read("fitted.yaml");
  const auto value = [&](const std::string& key) {
    const std::size_t at = text.find(key + ": ");
    return at == text.npos ? std::nan("") : std::stod(text.substr(at + key.size() + 2));
  };
  EXPECT_NEAR(value("travel_scale"), 1.012, 0.002);
  EXPECT_NEAR(value("turn_scale"), 1.001, 0.002);
  EXPECT_NEAR(value("drift_rad_per_m"), 0.001, 0.0005);
  EXPECT_NEAR(value("range_noise_m"), 0.005, 0.001);
  EXPECT_EQ(value("beams"), 361);
  EXPECT_EQ(value("period_ms"), 100);
  folder.write("scenario.yaml",
               "format: 1\nname: fitted\nuntil_s: 5\nrobot_types: {include: fitted.yaml}\n"
               "world: {shapes: [{name: wall, corners_m: [9, 9, 10, 10]}]}\n"
               "robots: [{name: r, type: like, start: [0, 0, 0]}]\n");
  const runs::Outcome checked =
      runs::outcome_of({.words = {runs::program().string(), "check", (folder / "scenario.yaml").string()}});
  EXPECT_EQ(checked.status, 0) << checked.errors;
}

}  // namespace
}  // namespace waitpoint::tools
