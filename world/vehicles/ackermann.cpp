// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/ackermann.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::world {
namespace {

// The steering angle for w_rad_s at v_m_s, clamped to the range of the steering; at least one of the two is not 0.
double steering_for(const BaseDescription& base, double v_m_s, double w_rad_s) {
  const double across = v_m_s < 0 ? -base.wheelbase_m * w_rad_s : base.wheelbase_m * w_rad_s;
  return std::clamp(exact::atan2(across, std::fabs(v_m_s)), -base.steering_max_rad, base.steering_max_rad);
}

double wanted_steering(const BaseDescription& base, Velocity wanted, double now_rad) {
  return wanted.v_m_s == 0 && wanted.w_rad_s == 0 ? now_rad : steering_for(base, wanted.v_m_s, wanted.w_rad_s);
}

double slowed(const BaseDescription& base, double v_m_s, double steering_rad) {
  const double curvature = std::fabs(curvature_per_m(base, steering_rad));
  const double v_max = curvature * base.v_max_m_s > base.w_max_rad_s ? base.w_max_rad_s / curvature : base.v_max_m_s;
  return std::clamp(v_m_s, -v_max, v_max);
}

}  // namespace

double curvature_per_m(const BaseDescription& base, double steering_rad) {
  const auto [s, c] = exact::sincos(steering_rad);
  return s / (c * base.wheelbase_m);
}

Velocity limited_by_steering(const BaseDescription& base, Velocity wanted) {
  if (wanted.v_m_s == 0) return {};
  const double steering = steering_for(base, wanted.v_m_s, wanted.w_rad_s);
  const double v = slowed(base, wanted.v_m_s, steering);
  return {v, v * curvature_per_m(base, steering)};
}

BaseMotion next_of_steering(const BaseDescription& base, const BaseMotion& now, Velocity wanted, double step_s) {
  const double faster = base.v_acceleration_m_s2 * step_s, further = base.steering_rate_rad_s * step_s;
  double v =
      std::clamp(limited_by_steering(base, wanted).v_m_s, now.velocity.v_m_s - faster, now.velocity.v_m_s + faster);
  double steering = std::clamp(wanted_steering(base, wanted, now.steering_rad), now.steering_rad - further,
                               now.steering_rad + further);
  // Together they must not exceed the limit of the turn. The present state does not, so the rising one is held back.
  const double was = std::fabs(now.steering_rad);
  if (std::fabs(steering) > was) {
    const double bound = std::max(was, steering_for(base, std::fabs(v), base.w_max_rad_s));
    steering = std::clamp(steering, -bound, bound);
  }
  v = slowed(base, v, steering);
  return {{v, v * curvature_per_m(base, steering)}, steering};
}

}  // namespace waitpoint::world
