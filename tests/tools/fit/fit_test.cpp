// SPDX-License-Identifier: BSD-3-Clause
// What is fitted to a log of known errors is these errors.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/error.hpp"
#include "core/random.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/folder.hpp"
#include "tools/fit/compare.hpp"
#include "tools/fit/laser_fit.hpp"
#include "tools/fit/odometry_fit.hpp"
#include "tools/fit/two_samples.hpp"

namespace waitpoint::tools {
namespace {

/// A drive of `length_m` in turns to both sides, with its odometry, and the localisation's own noise.
struct Drive {
  std::vector<Pose> measured, localised;

  Drive(double length_m, const OdometryFit& errors, double localisation_noise_m) {
    RandomStream random(7, "drive", "noise");
    std::uint64_t draw = 0;
    Pose truth, odometry;
    constexpr double step_m = 0.1;
    const auto steps = static_cast<int>(length_m / step_m);
    for (int i = 0; i < steps; ++i) {
      const double turn = 0.12 * exact::sin(0.05 * i) + 0.01;
      truth = compose(truth, {step_m, 0, turn});
      const double travel_noise = errors.travel_noise_m_per_sqrt_m * std::sqrt(step_m) * random.normal(draw++);
      const double turn_noise = errors.turn_noise_rad_per_sqrt_m * std::sqrt(step_m) * random.normal(draw++);
      const double by_turn = errors.turn_noise_rad_per_sqrt_rad * std::sqrt(std::fabs(turn)) * random.normal(draw++);
      const double measured_turn = errors.turn_scale * turn + errors.drift_rad_per_m * step_m + turn_noise + by_turn;
      odometry = compose(odometry, {errors.travel_scale * step_m + travel_noise, 0, measured_turn});
      const double off_x = localisation_noise_m * random.normal(draw++),
                   off_y = localisation_noise_m * random.normal(draw++);
      measured.push_back(odometry);
      localised.push_back({truth.x + off_x, truth.y + off_y, truth.heading});
    }
  }
};

TEST(Fit, TheErrorsOfTheOdometryAreFoundAlsoBehindTheNoiseOfLocalisation) {
  const OdometryFit errors{.travel_scale = 1.02,
                           .turn_scale = 0.98,
                           .drift_rad_per_m = 0.004,
                           .travel_noise_m_per_sqrt_m = 0.02,
                           .turn_noise_rad_per_sqrt_m = 0.01,
                           .turn_noise_rad_per_sqrt_rad = 0};
  const Drive drive(2000, errors, 0.01);
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised);
  EXPECT_NEAR(fit.travel_scale, errors.travel_scale, 0.003);
  EXPECT_NEAR(fit.turn_scale, errors.turn_scale, 0.003);
  EXPECT_NEAR(fit.drift_rad_per_m, errors.drift_rad_per_m, 0.001);
  EXPECT_NEAR(fit.travel_noise_m_per_sqrt_m, errors.travel_noise_m_per_sqrt_m, 0.004);
  EXPECT_NEAR(fit.turn_noise_rad_per_sqrt_m, errors.turn_noise_rad_per_sqrt_m, 0.003);
  EXPECT_GT(fit.stretches, 2000u);
}

TEST(Fit, ExactOdometryHasNoErrorsWhateverTheNoiseOfLocalisation) {
  const Drive drive(500, {}, 0.01);
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised);
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
  const OdometryFit fit = fit_odometry(drive.measured, drive.localised);
  EXPECT_GT(fit.left_out, 0u);
  EXPECT_NEAR(fit.turn_noise_rad_per_sqrt_m, 0.01, 0.003);
}

TEST(Fit, AShortLogIsRefused) {
  const Drive drive(30, {}, 0);
  EXPECT_THROW(fit_odometry(drive.measured, drive.localised), BadInput);
}

/// Scans of a wall at rest, ten a second, without those of `missing`.
logs::SensorLog scans_at_rest(double noise_m, double step_m, double dropout) {
  RandomStream random(3, "laser", "noise");
  std::uint64_t draw = 0;
  logs::SensorLog log;
  log.file = "wall.log";
  for (std::uint64_t i = 0; i < 200; ++i) {
    if (i == 50) continue;
    const double date_s = 0.1 * static_cast<double>(i) + 0.002 * random.normal(draw++);
    logs::LoggedScan scan{.stamp = Time() + Duration::from_seconds(5 + date_s),
                          .place = i,
                          .first_angle_rad = -1,
                          .angle_step_rad = 0.02,
                          .range_max_m = 80,
                          .odometry = Pose()};
    for (int beam = 0; beam < 101; ++beam) {
      const double range = 3 + 0.013 * beam + noise_m * random.normal(draw++);
      scan.range_m.push_back(
          static_cast<float>(random.uniform(draw++) < dropout ? 81.9 : std::round(range / step_m) * step_m));
    }
    log.scans.push_back(std::move(scan));
  }
  return log;
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

TEST(TwoSamples, OfOneDistributionAreProbableAndOfTwoAreNot) {
  RandomStream random(5, "samples", "normal");
  std::vector<double> a, b, shifted;
  for (std::uint64_t i = 0; i < 400; ++i) {
    a.push_back(random.normal(3 * i));
    b.push_back(random.normal(3 * i + 1));
    shifted.push_back(0.5 + random.normal(3 * i + 2));
  }
  EXPECT_GT(compare_samples(a, b).probability, 0.05);
  EXPECT_LT(compare_samples(a, shifted).probability, 1e-6);
  EXPECT_NEAR(compare_samples(a, shifted).distance, 0.2, 0.06);
  EXPECT_EQ(compare_samples({1, 2, 2, 3}, {1, 2, 2, 3}).distance, 0);
  EXPECT_EQ(compare_samples({1, 2}, {3, 4}).distance, 1);
}

// Kolmogorov's distribution: 5 % of distances exceed 1.36 sqrt(2 / n).
TEST(TwoSamples, TheProbabilityIsThatOfKolmogorovsTables) {
  std::vector<double> a, b;
  for (int i = 0; i < 10000; ++i) {
    a.push_back(i);
    b.push_back(i + 10000 * 1.358 * std::sqrt(2.0 / 10000));
  }
  EXPECT_NEAR(compare_samples(a, b).probability, 0.05, 0.003);
}

TEST(Compare, ALogIsLikeItselfAndUnlikeThatOfANoisierRobot) {
  ReplayedLog first{.log = scans_at_rest(0.003, 0.01, 0), .order = {}, .measured = {}, .localised = {}};
  ReplayedLog second{.log = scans_at_rest(0.02, 0.01, 0), .order = {}, .measured = {}, .localised = {}};
  const Drive careful(500, {.turn_noise_rad_per_sqrt_m = 0.005}, 0), rough(500, {.turn_noise_rad_per_sqrt_m = 0.05}, 0);
  std::tie(first.measured, first.localised) = std::pair(careful.measured, careful.localised);
  std::tie(second.measured, second.localised) = std::pair(rough.measured, rough.localised);
  first.order = logs::playing_order(first.log);
  second.order = logs::playing_order(second.log);
  const std::vector<Sample> a = samples_of(first), b = samples_of(second);
  for (const std::size_t quantity : {1u, 5u}) {  // heading, and echoes about their segments
    EXPECT_EQ(compare_samples(a[quantity].values, a[quantity].values).probability, 1);
    EXPECT_LT(compare_samples(a[quantity].values, b[quantity].values).probability, 1e-6) << a[quantity].quantity;
  }
  EXPECT_NE(comparison_text(a, b).find("time between scans, s"), std::string::npos);
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
