// SPDX-License-Identifier: BSD-3-Clause
// Dead reckoning from the controller's accumulated travel and turn, with its covariance.
//
// Each report moves the pose along an arc: travel d, sideways travel l to the left (bases with sideways motion) and
// turn a since the last report, with the heading halfway along the chord. The covariance of (x, y, heading) grows by P
// <- F P F' + G Q G', F and G the Jacobians of that motion by pose and by (d, l, a), Q = diag(k_d |d|, k_d |l|, k_a |a|
// + k_da (|d| + |l|)). (Thrun, Burgard, Fox, "Probabilistic Robotics", ch. 5; Borenstein and Feng 1996.)
#pragma once

#include <cstdint>

#include "modules/posters/position.hpp"

namespace waitpoint::rflex {

/// Growth of the uncertainty: variances per metre travelled and per radian turned.
struct OdometryNoise {
  double travel_variance_m2_per_m = 1e-4;
  double turn_variance_rad2_per_rad = 4e-4;
  double turn_variance_rad2_per_m = 1e-4;

  static void fields(auto field) {
    field("travel_variance_m2_per_m", &OdometryNoise::travel_variance_m2_per_m, "growth of the variance of travel");
    field("turn_variance_rad2_per_rad", &OdometryNoise::turn_variance_rad2_per_rad,
          "growth of the variance of the heading, by turns");
    field("turn_variance_rad2_per_m", &OdometryNoise::turn_variance_rad2_per_m,
          "growth of the variance of the heading, by travel");
  }
};

class DeadReckoning {
 public:
  /// `units_per_m` and `units_per_rad` are the controller's.
  DeadReckoning(const OdometryNoise& noise, double units_per_m, double units_per_rad);

  /// Adds a report; the first only initialises the counters.
  void advance(Time date, std::int64_t travel_units, std::int64_t turn_units, std::int64_t side_units = 0);
  /// Sets the pose, and the uncertainty to zero.
  void set(const Pose& pose);

  const posters::PositionEstimate& position() const { return position_; }

 private:
  OdometryNoise noise_;
  double metres_per_unit_, radians_per_unit_;
  bool started_ = false;
  std::int64_t travel_units_ = 0, turn_units_ = 0, side_units_ = 0;
  posters::PositionEstimate position_;
};

}  // namespace waitpoint::rflex
