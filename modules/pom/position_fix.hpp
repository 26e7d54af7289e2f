// SPDX-License-Identifier: BSD-3-Clause
// A fix of a satellite receiver in the fusion: where the robot's antenna is, and nothing of its heading.
//
//   z = p + R(heading) a        a: the antenna in the robot's frame
//
// What fixes have in common for minutes does not average out, however many there are: they do not make the fusion surer
// of a coordinate than that, and where it is surer already they correct nothing.
#pragma once

#include "core/fields.hpp"
#include "modules/pom/uncertain_pose.hpp"

namespace waitpoint::pom {

struct FixParameters {
  bool gps = false;                                 ///< whether the robot's receiver is a source
  double gps_antenna_x_m = 0, gps_antenna_y_m = 0;  ///< in the robot's frame
  double gps_noise_m = 1;                           ///< standard deviation on each axis, anew in every fix
  double gps_drift_m = 0;                           ///< that of the error that fixes have in common
  double gps_gate = 13.82;                          ///< chi square of 2 degrees of freedom at 99.9 %

  static constexpr auto fields() {
    return std::tuple(field("gps", &FixParameters::gps), field("gps_antenna_x_m", &FixParameters::gps_antenna_x_m),
                      field("gps_antenna_y_m", &FixParameters::gps_antenna_y_m),
                      field("gps_noise_m", &FixParameters::gps_noise_m),
                      field("gps_drift_m", &FixParameters::gps_drift_m), field("gps_gate", &FixParameters::gps_gate));
  }
};

struct PositionFix {
  Point position, antenna;
  double noise_m2 = 0, common_m2 = 0;  ///< variances on each axis

  double variance_m2() const { return noise_m2 + common_m2; }
};

PositionFix fix_at(Point position, const FixParameters& parameters);

/// Squared Mahalanobis distance of the antenna from where a pose has it (2 degrees of freedom). Infinite if neither has
/// any uncertainty.
double disagreement(const UncertainPose& predicted, const PositionFix& fix);

/// The Kalman fusion with an independent pose. `prior` if neither has any uncertainty, or if no axis of its error
/// ellipse is longer than that of what fixes have in common.
UncertainPose fuse(const UncertainPose& prior, const PositionFix& fix);

/// The pose with that heading whose antenna is where the fix has it.
UncertainPose moved_to(const UncertainPose& prior, const PositionFix& fix);

}  // namespace waitpoint::pom
