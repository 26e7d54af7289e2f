// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/base.hpp"

#include <algorithm>
#include <cmath>

#include "world/vehicles/ackermann.hpp"

namespace waitpoint::world {
namespace {

using Kind = BaseDescription::Kind;

double approach(double now, double target, double change_max) {
  return std::clamp(target, now - change_max, now + change_max);
}

double wheel_speed(const BaseDescription& base, Velocity velocity) {
  return std::fabs(velocity.v_m_s) + std::fabs(velocity.w_rad_s) * 0.5 * base.axle_m;
}

// The vector, shortened to at most that length.
Point at_most(Point vector, double length_max) {
  const double longer = length(vector);
  return longer > length_max ? (length_max / longer) * vector : vector;
}

Velocity each_axis(const BaseDescription& base, Velocity wanted) {
  return {std::clamp(wanted.v_m_s, -base.v_max_m_s, base.v_max_m_s),
          std::clamp(wanted.w_rad_s, -base.w_max_rad_s, base.w_max_rad_s)};
}

Velocity approach_each(const BaseDescription& base, Velocity now, Velocity target, double step_s) {
  return {approach(now.v_m_s, target.v_m_s, base.v_acceleration_m_s2 * step_s),
          approach(now.w_rad_s, target.w_rad_s, base.w_acceleration_rad_s2 * step_s)};
}

// --- two driven wheels, or sides ---

Velocity limited_by_wheels(const BaseDescription& base, Velocity wanted) {
  const Velocity velocity = each_axis(base, wanted);
  const double wheel = wheel_speed(base, velocity);
  if (wheel <= base.v_max_m_s) return velocity;
  const double scale = base.v_max_m_s / wheel;
  return {scale * velocity.v_m_s, scale * velocity.w_rad_s};
}

Velocity next_of_wheels(const BaseDescription& base, Velocity now, Velocity wanted, double step_s) {
  Velocity next = approach_each(base, now, limited_by_wheels(base, wanted), step_s);
  if (wheel_speed(base, next) <= base.v_max_m_s) return next;
  // One component has fallen by less than the other has risen: the rising one is held back. (If both rise, they end
  // within the target's limits; if both fall, within the present ones.)
  if (std::fabs(next.w_rad_s) > std::fabs(now.w_rad_s)) {
    const double w_max = (base.v_max_m_s - std::fabs(next.v_m_s)) / (0.5 * base.axle_m);
    next.w_rad_s = std::clamp(next.w_rad_s, -w_max, w_max);
  } else {
    const double v_max = base.v_max_m_s - std::fabs(next.w_rad_s) * 0.5 * base.axle_m;
    next.v_m_s = std::clamp(next.v_m_s, -v_max, v_max);
  }
  return next;
}

// --- any direction ---

Velocity limited_anyway(const BaseDescription& base, Velocity wanted) {
  const Point planar = at_most({wanted.v_m_s, wanted.side_m_s}, base.v_max_m_s);
  const double climb_max = base.kind == Kind::aerial ? base.climb_max_m_s : 0;
  return {planar.x, std::clamp(wanted.w_rad_s, -base.w_max_rad_s, base.w_max_rad_s), planar.y,
          std::clamp(wanted.climb_m_s, -climb_max, climb_max)};
}

Velocity next_anyway(const BaseDescription& base, Velocity now, Velocity wanted, double step_s) {
  const Velocity target = limited_anyway(base, wanted);
  const Point from = {now.v_m_s, now.side_m_s}, to = {target.v_m_s, target.side_m_s};
  const double change_max = base.v_acceleration_m_s2 * step_s;
  const Point planar = length(to - from) <= change_max ? to : from + at_most(to - from, change_max);
  return {planar.x, approach(now.w_rad_s, target.w_rad_s, base.w_acceleration_rad_s2 * step_s), planar.y,
          approach(now.climb_m_s, target.climb_m_s, base.climb_acceleration_m_s2 * step_s)};
}

// --- slip in turns ---

Velocity of_wheels(const BaseDescription& base, Velocity body) {
  return {body.v_m_s, base.effective_axle_ratio * body.w_rad_s};
}
Velocity of_body(const BaseDescription& base, Velocity wheels) {
  return {wheels.v_m_s, wheels.w_rad_s / base.effective_axle_ratio};
}

}  // namespace

Velocity limited(const BaseDescription& base, Velocity wanted) {
  switch (base.kind) {
    case Kind::synchro: return each_axis(base, wanted);
    case Kind::differential: return limited_by_wheels(base, wanted);
    case Kind::skid_steer: return of_body(base, limited_by_wheels(base, wanted));
    case Kind::ackermann: return limited_by_steering(base, wanted);
    case Kind::omni:
    case Kind::aerial: break;
  }
  return limited_anyway(base, wanted);
}

Velocity nearest_held(const BaseDescription& base, Velocity moving) {
  return limited(base, base.kind == Kind::skid_steer ? of_wheels(base, moving) : moving);
}

BaseMotion next_motion(const BaseDescription& base, const BaseMotion& now, Velocity wanted, double step_s) {
  switch (base.kind) {
    case Kind::synchro: return {approach_each(base, now.velocity, each_axis(base, wanted), step_s)};
    case Kind::differential: return {next_of_wheels(base, now.velocity, wanted, step_s)};
    case Kind::skid_steer: return {of_body(base, next_of_wheels(base, of_wheels(base, now.velocity), wanted, step_s))};
    case Kind::ackermann: return next_of_steering(base, now, wanted, step_s);
    case Kind::omni:
    case Kind::aerial: break;
  }
  return {next_anyway(base, now.velocity, wanted, step_s)};
}

Arc as_wheels_count(const BaseDescription& base, const Arc& arc) {
  Arc counted = arc;
  if (base.kind == Kind::skid_steer) counted.turn_rad *= base.effective_axle_ratio;
  if (base.kind != Kind::omni && base.kind != Kind::aerial) counted.side_m = 0;
  return counted;
}

Battery::Reading base_battery(const BaseDescription& base, double elapsed_s, double travelled_m) {
  const double used = std::min(elapsed_s / base.battery_capacity_s + travelled_m / base.battery_capacity_m, 1.0);
  return {.volts = base.battery_volts_full - (base.battery_volts_full - base.battery_volts_empty) * used,
          .charge = 1 - used};
}

}  // namespace waitpoint::world
