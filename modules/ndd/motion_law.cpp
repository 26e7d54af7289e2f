// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/motion_law.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::ndd {
namespace {

constexpr double least_slowing = 0.3;  // by proximity alone; SpeedLimiter slows further if necessary
constexpr int path_samples = 3;
constexpr double decision_s = 0.1;  // time until the next decision, for the possible loss of speed

// The point after `s_m` on the arc of the given curvature that starts at the origin, ahead.
Point along_arc(double s_m, double curvature_per_m) {
  const double turn = s_m * curvature_per_m;
  if (std::fabs(turn) < 1e-6) return {s_m, 0.5 * s_m * turn};
  const auto [sine, cosine] = exact::sincos(turn);
  return {sine / curvature_per_m, (1 - cosine) / curvature_per_m};
}

}  // namespace

double stopping_distance_m(const Parameters& p, double v_m_s) {
  return v_m_s * p.reaction_s + v_m_s * v_m_s / (2 * p.braking_m_s2);
}

Point along_arc(double length_m, double turn_rad, double part) {
  if (length_m == 0) return {};
  return along_arc(length_m * part, turn_rad / length_m);
}

Speeds motion_law(const Parameters& p, double direction_rad, double safety, double v_m_s_max) {
  const double facing = std::max(0.0, 1 - std::fabs(direction_rad) / (exact::pi / 2));
  const double v = std::min(v_m_s_max, p.v_m_s_max * facing * std::max(least_slowing, safety));
  const double w = std::clamp(p.turning_gain_per_s * direction_rad, -p.w_rad_s_max, p.w_rad_s_max);
  return {v, w};
}

Speeds SpeedLimiter::limit(const Speeds& wanted, const Speeds& measured, std::span<const Point> obstacles) {
  near_.clear();
  distance_m_.clear();
  const double fastest = std::max({wanted.v_m_s, measured.v_m_s, parameters_.creep_m_s});
  const double reach =
      parameters_.robot_radius_m + parameters_.emergency_distance_m + 2 * stopping_distance_m(parameters_, fastest);
  for (const Point p : obstacles) {
    const double square = dot(p, p);
    if (square >= reach * reach) continue;
    near_.push_back(p);
    distance_m_.push_back(std::sqrt(square));
  }
  const double slowest = measured.v_m_s - parameters_.braking_m_s2 * decision_s;
  double w = wanted.w_rad_s;
  for (int step = turn_steps; step > 0 && !can_stop(slowest, w); --step) {
    w = wanted.w_rad_s * (step - 1) / turn_steps;
  }
  for (int step = speed_steps; step > 0; --step) {
    const double v = wanted.v_m_s * step / speed_steps;
    if (can_stop(v, w) && can_stop(v, measured.w_rad_s) && can_stop(v, 0)) return {v, w};
  }
  const double creep = std::min(parameters_.creep_m_s, wanted.v_m_s);
  return {can_creep(creep, w) ? creep : 0, w};
}

bool SpeedLimiter::can_stop(double v_m_s, double w_rad_s) const {
  if (v_m_s <= 0) return true;
  const double hull = parameters_.robot_radius_m + parameters_.emergency_distance_m;
  const double stop = stopping_distance_m(parameters_, v_m_s);
  for (int k = 1; k <= path_samples; ++k) {
    const Point q = along_arc(stop * k / path_samples, w_rad_s / v_m_s);
    for (std::size_t i = 0; i < near_.size(); ++i) {
      if (dot(q, near_[i]) > 0.5 * std::max(0.0, distance_m_[i] - hull) * distance_m_[i]) return false;
    }
  }
  return true;
}

bool SpeedLimiter::can_creep(double v_m_s, double w_rad_s) const {
  if (v_m_s <= 0) return true;
  const double hull = parameters_.robot_radius_m + 0.5 * parameters_.emergency_distance_m;
  // Twice the stopping path: the other half is for an obstacle that creeps, too.
  const Point q = along_arc(2 * stopping_distance_m(parameters_, v_m_s), w_rad_s / v_m_s);
  for (const Point p : near_) {
    const Point rest = p - q;
    if (dot(q, p) > 0 && dot(rest, rest) < hull * hull) return false;
  }
  return true;
}

}  // namespace waitpoint::ndd
