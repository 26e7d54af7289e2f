// SPDX-License-Identifier: BSD-3-Clause
// Logs with known errors.
#pragma once

#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "modules/logs/sensor_log.hpp"
#include "tools/fit/odometry_fit.hpp"

namespace waitpoint::tools {

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

/// Scans of a wall at rest, ten a second, without those of `missing`.
inline logs::SensorLog scans_at_rest(double noise_m, double step_m, double dropout) {
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

}  // namespace waitpoint::tools
