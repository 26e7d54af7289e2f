// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/shape_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::ndd {
namespace {

constexpr int poses_max = 12;
constexpr double pose_step_m = 0.08, pose_step_rad = 0.12;
constexpr double tolerance_m = 1e-3;  // of an obstacle within the emergency distance: noise, not an approach

}  // namespace

Speeds ShapeLimiter::limit(const Speeds& wanted, const Speeds& measured, std::span<const Point> obstacles) {
  take_near(std::max({wanted.v_m_s, std::fabs(measured.v_m_s), parameters_.creep_m_s}), obstacles);
  for (int part = turn_steps; part >= 0; --part) {
    const double w = wanted.w_rad_s * part / turn_steps;
    for (int step = speed_steps; step > 0 && wanted.v_m_s > 0; --step) {
      const double v = wanted.v_m_s * step / speed_steps;
      if (can_stop(v, w, &Near::least_m) && can_stop(v, measured.w_rad_s, &Near::least_m) &&
          can_stop(v, 0, &Near::least_m))
        return {v, w};
    }
    const double creep = std::min(parameters_.creep_m_s, wanted.v_m_s);
    if (creep > 0 && can_stop(creep, w, &Near::least_slow_m)) return {creep, w};
    if (w != 0 && can_turn(w)) return {0, w};
  }
  if (can_stop(-parameters_.back_out_m_s, 0, &Near::least_slow_m)) return {-parameters_.back_out_m_s, 0};
  return {};
}

void ShapeLimiter::take_near(double fastest_m_s, std::span<const Point> obstacles) {
  near_.clear();
  const double emergency_m = parameters_.emergency_distance_m;
  const double reach_m = footprint_.radius_m() + emergency_m + 2 * stopping_distance_m(parameters_, fastest_m_s);
  for (const Point p : obstacles) {
    if (dot(p, p) >= reach_m * reach_m) continue;
    const double now_m = footprint_.distance_m(p);
    const double not_nearer_m = now_m - tolerance_m;
    near_.push_back({p, now_m > emergency_m ? 0.5 * (now_m + emergency_m) : not_nearer_m,
                     std::min(not_nearer_m, 0.5 * emergency_m)});
  }
}

bool ShapeLimiter::is_free(double length_m, double turn_rad, double Near::*least) const {
  const double parts = std::max(std::fabs(length_m) / pose_step_m, std::fabs(turn_rad) / pose_step_rad);
  const int poses = std::clamp(static_cast<int>(std::ceil(parts)), 1, poses_max);
  for (int k = 1; k <= poses; ++k) {
    const double turn = turn_rad * k / poses;
    const Point at = along_arc(length_m, turn_rad, static_cast<double>(k) / poses);
    const exact::SinCos facing = exact::sincos(turn);
    for (const Near& near : near_) {
      const Point d = near.point - at;
      const double clear_m = footprint_.radius_m() + near.*least;
      if (dot(d, d) >= clear_m * clear_m) continue;
      const Point own = {facing.cos * d.x + facing.sin * d.y, facing.cos * d.y - facing.sin * d.x};
      if (footprint_.distance_m(own) < near.*least) return false;
    }
  }
  return true;
}

bool ShapeLimiter::can_stop(double v_m_s, double w_rad_s, double Near::*least) const {
  const double stop_m = stopping_distance_m(parameters_, std::fabs(v_m_s));
  return is_free(v_m_s < 0 ? -stop_m : stop_m, w_rad_s * stop_m / std::fabs(v_m_s), least);
}

bool ShapeLimiter::can_turn(double w_rad_s) const {
  const double w = std::fabs(w_rad_s);
  const double turn = w * parameters_.reaction_s + w * w / (2 * parameters_.turn_braking_rad_s2);
  return is_free(0, w_rad_s < 0 ? -turn : turn, &Near::least_slow_m);
}

}  // namespace waitpoint::ndd
