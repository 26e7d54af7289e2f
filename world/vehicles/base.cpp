// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/base.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::world {
namespace {

double approach(double now, double target, double change_max) {
  return std::clamp(target, now - change_max, now + change_max);
}

double wheel_speed(const BaseDescription& base, Velocity velocity) {
  return std::fabs(velocity.v_m_s) + std::fabs(velocity.w_rad_s) * 0.5 * base.axle_m;
}

}  // namespace

Velocity limited(const BaseDescription& base, Velocity wanted) {
  Velocity velocity = {std::clamp(wanted.v_m_s, -base.v_max_m_s, base.v_max_m_s),
                       std::clamp(wanted.w_rad_s, -base.w_max_rad_s, base.w_max_rad_s)};
  if (base.kind == BaseDescription::Kind::synchro) return velocity;
  const double wheel = wheel_speed(base, velocity);
  if (wheel <= base.v_max_m_s) return velocity;
  const double scale = base.v_max_m_s / wheel;
  return {scale * velocity.v_m_s, scale * velocity.w_rad_s};
}

Velocity next_velocity(const BaseDescription& base, Velocity now, Velocity wanted, double step_s) {
  const Velocity target = limited(base, wanted);
  Velocity next = {approach(now.v_m_s, target.v_m_s, base.v_acceleration_m_s2 * step_s),
                   approach(now.w_rad_s, target.w_rad_s, base.w_acceleration_rad_s2 * step_s)};
  if (base.kind == BaseDescription::Kind::synchro || wheel_speed(base, next) <= base.v_max_m_s) return next;
  // One component has not fallen as far as the other has risen: the rising one waits. (Both rising end within the
  // target's limits, both falling within the present ones.)
  if (std::fabs(next.w_rad_s) > std::fabs(now.w_rad_s)) {
    const double w_max = (base.v_max_m_s - std::fabs(next.v_m_s)) / (0.5 * base.axle_m);
    next.w_rad_s = std::clamp(next.w_rad_s, -w_max, w_max);
  } else {
    const double v_max = base.v_max_m_s - std::fabs(next.w_rad_s) * 0.5 * base.axle_m;
    next.v_m_s = std::clamp(next.v_m_s, -v_max, v_max);
  }
  return next;
}

double battery_volts(const BaseDescription& base, double elapsed_s, double travelled_m) {
  const double used = elapsed_s / base.battery_capacity_s + travelled_m / base.battery_capacity_m;
  return base.battery_volts_full - (base.battery_volts_full - base.battery_volts_empty) * std::min(used, 1.0);
}

}  // namespace waitpoint::world
