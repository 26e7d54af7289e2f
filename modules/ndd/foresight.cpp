// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/foresight.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::ndd {
namespace {

constexpr double step_s = 0.1, turning_s = 0.5;
constexpr double margin_m = 0.05, margin_m_per_s = 0.05;  // of the discs' positions, the later the more
constexpr double far_m = 0.5;
constexpr double of_disc_m = 0.15;  // points this near to a disc in motion are its echoes
constexpr int speeds_ahead = 4, speeds_back = 2, turns_each_way = 3;
// Of a contact at once, of closeness, and of deviation from the wanted and from the last speeds.
constexpr double contact_weight = 100, closeness_weight = 4, wanted_weight = 1, last_weight = 0.2;

double approached(double from, double to, double step) { return from + std::clamp(to - from, -step, step); }

}  // namespace

Speeds Foresight::choose(const Speeds& wanted, const Speeds& measured, std::span<const Disc> moving,
                         std::span<const Point> points) {
  Speeds best = wanted;
  if (!moving.empty()) {
    take_standing(moving, points);
    double least = cost(wanted, wanted, measured, moving);
    for (int i = -speeds_back; i <= speeds_ahead; ++i) {
      for (int k = -turns_each_way; k <= turns_each_way; ++k) {
        const Speeds speeds = {parameters_.v_m_s_max * i / speeds_ahead, parameters_.w_rad_s_max * k / turns_each_way};
        const double other = cost(speeds, wanted, measured, moving);
        if (other >= least) continue;
        least = other;
        best = speeds;
      }
    }
  }
  last_ = best;
  return best;
}

void Foresight::take_standing(std::span<const Disc> moving, std::span<const Point> points) {
  const double reach_m = footprint_.radius_m() + parameters_.v_m_s_max * parameters_.foresight_s;
  standing_.clear();
  for (const Point p : points) {
    if (dot(p, p) > reach_m * reach_m) continue;
    const bool moves = std::any_of(moving.begin(), moving.end(), [&](const Disc& disc) {
      return length(p - disc.centre) < disc.radius_m + of_disc_m;
    });
    if (!moves) standing_.push_back(p);
  }
}

double Foresight::cost(const Speeds& speeds, const Speeds& wanted, const Speeds& measured,
                       std::span<const Disc> moving) const {
  const auto deviation = [&](const Speeds& from) {
    return std::fabs(speeds.v_m_s - from.v_m_s) / parameters_.v_m_s_max +
           0.5 * std::fabs(speeds.w_rad_s - from.w_rad_s) / parameters_.w_rad_s_max;
  };
  const Outlook outlook = follow(speeds, measured, moving);
  const double early = std::max(0.0, 1 - outlook.contact_s / parameters_.foresight_s);
  return contact_weight * early + closeness_weight * outlook.closeness + wanted_weight * deviation(wanted) +
         last_weight * deviation(last_);
}

Foresight::Outlook Foresight::follow(const Speeds& commanded, const Speeds& measured,
                                     std::span<const Disc> moving) const {
  Outlook outlook = {parameters_.foresight_s, 0};
  Speeds speeds = measured;
  Pose robot;
  bool stands = false;
  const double stop_s = parameters_.reaction_s + std::fabs(measured.v_m_s) / parameters_.braking_m_s2;
  for (double t = step_s; t < parameters_.foresight_s + 0.5 * step_s; t += step_s) {
    const double w = t <= turning_s ? commanded.w_rad_s : 0;
    speeds.v_m_s = approached(speeds.v_m_s, stands ? 0 : commanded.v_m_s, parameters_.braking_m_s2 * step_s);
    speeds.w_rad_s = approached(speeds.w_rad_s, stands ? 0 : w, parameters_.turn_braking_rad_s2 * step_s);
    const double turn = speeds.w_rad_s * step_s;
    const Point to = along_arc(speeds.v_m_s * step_s, turn, 1);
    robot = compose(robot, {to.x, to.y, turn});
    const auto distance_m = [&](Point p, double radius_m, double within_m) {
      const Point d = p - robot.position();
      const double reach_m = footprint_.radius_m() + radius_m + within_m;
      if (dot(d, d) >= reach_m * reach_m) return within_m;
      return footprint_.distance_m(between(robot, {p.x, p.y, 0}).position()) - radius_m;
    };
    for (const Disc& disc : moving) {
      const double clear_m =
          distance_m(disc.centre + t * disc.velocity, disc.radius_m, far_m) - margin_m - margin_m_per_s * t;
      if (clear_m <= 0) return {t, 1};
      outlook.closeness = std::max(outlook.closeness, 1 - clear_m / far_m);
    }
    if (stands) continue;
    for (const Point p : standing_) {
      if (distance_m(p, 0, 2 * margin_m) >= margin_m) continue;
      if (t < stop_s) return {t, 1};
      stands = true;
      break;
    }
  }
  return outlook;
}

}  // namespace waitpoint::ndd
