// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/dead_reckoning.hpp"

#include <cmath>

namespace waitpoint::rflex {

DeadReckoning::DeadReckoning(const OdometryNoise& noise, double units_per_m, double units_per_rad)
    : noise_(noise), metres_per_unit_(1 / units_per_m), radians_per_unit_(1 / units_per_rad) {}

void DeadReckoning::set(const Pose& pose) {
  position_.pose = pose;
  position_.covariance = {};
}

void DeadReckoning::advance(Time date, std::int64_t travel_units, std::int64_t turn_units, std::int64_t side_units) {
  const double d = static_cast<double>(travel_units - travel_units_) * metres_per_unit_;
  const double a = static_cast<double>(turn_units - turn_units_) * radians_per_unit_;
  const double l = static_cast<double>(side_units - side_units_) * metres_per_unit_;
  position_.date = date;
  side_units_ = side_units;
  travel_units_ = travel_units;
  turn_units_ = turn_units;
  if (!started_) {
    started_ = true;
    return;
  }
  Pose& pose = position_.pose;
  const auto [s, c] = exact::sincos(pose.heading + 0.5 * a);
  double dx = d * c, dy = d * s;
  if (l != 0) {
    dx -= l * s;
    dy += l * c;
  }
  pose.x += dx;
  pose.y += dy;
  pose.heading = exact::wrap_angle(pose.heading + a);

  // F is the identity except for (x, heading) = -dy and (y, heading) = dx.
  auto& p = position_.covariance;
  const double xx = p[0], xy = p[1], xh = p[2], yy = p[4], yh = p[5], hh = p[8];
  const double q_d = noise_.travel_variance_m2_per_m * std::fabs(d);
  const double q_l = noise_.travel_variance_m2_per_m * std::fabs(l);
  const double q_a = noise_.turn_variance_rad2_per_rad * std::fabs(a) +
                     noise_.turn_variance_rad2_per_m * (std::fabs(d) + std::fabs(l));
  // Half the turn's error acts on the direction of travel.
  const double gx = -0.5 * dy, gy = 0.5 * dx;
  p[0] = xx - 2 * dy * xh + dy * dy * hh + c * c * q_d + gx * gx * q_a;
  p[4] = yy + 2 * dx * yh + dx * dx * hh + s * s * q_d + gy * gy * q_a;
  p[1] = p[3] = xy + dx * xh - dy * yh - dx * dy * hh + c * s * q_d + gx * gy * q_a;
  p[2] = p[6] = xh - dy * hh + gx * q_a;
  p[5] = p[7] = yh + dx * hh + gy * q_a;
  p[8] = hh + q_a;
  if (l == 0) return;
  p[0] += s * s * q_l;
  p[4] += c * c * q_l;
  p[1] = p[3] = p[1] - c * s * q_l;
}

}  // namespace waitpoint::rflex
