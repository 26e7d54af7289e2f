// SPDX-License-Identifier: BSD-3-Clause
// The errors of a base's odometry, estimated from its poses and those that localisation found at the same times.
//
// Stretches of 1, 2, 4 and 8 m of travel are compared: D is a stretch's travel, A its turn, |A| the sum of its turns
// without their signs, all as localised. By least squares
//
//   travel measured / localised           travel_scale
//   turn measured - turn localised        (turn_scale - 1) A + drift D
//   squared residual of the travel        c + travel_noise^2 D
//   squared residual of the turn          c + turn_noise_per_m^2 D + turn_noise_per_rad^2 |A|
//
// The constants c take up the errors of the localisation itself, which do not grow with the stretch. Residuals beyond
// five robust deviations of their length, such as of lost localisation, are left out, and counted. So are stretches
// over which the localisation only followed the odometry, since the scans showed nothing to correct it by.
//
// A straight drive does not show the scale of turns, nor does a drive in one circle tell it from the drift: it stays 1.
//
// The model is that of the simulated odometry (docs/vehicles.md; Borenstein, Feng 1996), so that its parameters can be
// used there.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint::tools {

/// Travel and turn of a stretch as localised, with those of the odometry.
struct Stretch {
  double travel_m = 0, turn_rad = 0;
  double turns_rad = 0;  ///< without their signs
  double measured_travel_m = 0, measured_turn_rad = 0;
};

/// Stretches of `length_m` of travel by the odometry, one after another. The poses are those at the same times.
std::vector<Stretch> stretches_of(std::span<const Pose> measured, std::span<const Pose> localised, double length_m);

struct OdometryFit {
  double travel_scale = 1, turn_scale = 1, drift_rad_per_m = 0;
  double travel_noise_m_per_sqrt_m = 0, turn_noise_rad_per_sqrt_m = 0, turn_noise_rad_per_sqrt_rad = 0;
  bool turns_seen = true;  ///< false: turn_scale is not from the log
  std::uint64_t stretches = 0, left_out = 0;
  std::uint64_t uncorrected = 0;  ///< stretches besides, over which the localisation only followed the odometry
};

/// The poses at the same times, of the log `file`. BadInput for fewer than 40 m of travel, or of travel over which the
/// localisation corrects the odometry.
OdometryFit fit_odometry(std::span<const Pose> measured, std::span<const Pose> localised, const std::string& file);

}  // namespace waitpoint::tools
