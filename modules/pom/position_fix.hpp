// SPDX-License-Identifier: BSD-3-Clause
// A fix of a satellite receiver in the fusion: the position of the robot's antenna, without a heading.
//
//   z = p + R(heading) a        a: the antenna in the robot's frame
//
// The errors that fixes share for minutes do not average out: fixes never reduce the variance of a coordinate below
// that of the shared error, and where it is below already they have no effect.
#pragma once

#include "core/fields.hpp"
#include "modules/posters/uncertain_pose.hpp"

namespace waitpoint::pom {

using posters::UncertainPose;

struct FixParameters {
  bool gps = false;
  double gps_antenna_x_m = 0, gps_antenna_y_m = 0;
  double gps_noise_m = 1;
  double gps_drift_m = 0;
  double gps_gate = 13.82;

  static void fields(auto field) {
    field("gps", &FixParameters::gps, "true: the robot's receiver is a source");
    field("gps_antenna_x_m", &FixParameters::gps_antenna_x_m, "in the robot's frame");
    field("gps_antenna_y_m", &FixParameters::gps_antenna_y_m, "in the robot's frame");
    field("gps_noise_m", &FixParameters::gps_noise_m, "standard deviation per axis, independent in every fix");
    field("gps_drift_m", &FixParameters::gps_drift_m, "standard deviation per axis of the error shared by fixes");
    field("gps_gate", &FixParameters::gps_gate, "chi square of 2 degrees of freedom at 99.9 %");
  }
};

struct PositionFix {
  Point position, antenna;
  double noise_m2 = 0, common_m2 = 0;  ///< variances per axis: independent, shared

  double variance_m2() const { return noise_m2 + common_m2; }
};

PositionFix fix_at(Point position, const FixParameters& parameters);

/// Squared Mahalanobis distance between the fix and the antenna at a predicted pose (2 degrees of freedom). Infinite if
/// neither has any uncertainty.
double disagreement(const UncertainPose& predicted, const PositionFix& fix);

/// Kalman fusion with an independent pose. Returns `prior` if neither has any uncertainty, or if no axis of its error
/// ellipse exceeds the shared error of fixes.
UncertainPose fuse(const UncertainPose& prior, const PositionFix& fix);

/// The pose with the heading of `prior` and its antenna at the fix.
UncertainPose moved_to(const UncertainPose& prior, const PositionFix& fix);

}  // namespace waitpoint::pom
