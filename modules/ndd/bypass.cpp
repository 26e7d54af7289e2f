// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/bypass.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::ndd {
namespace {

constexpr double other_side_handicap_rad = 0.35;
constexpr double halving_handicap_rad = 0.25;
constexpr double turn_max_rad = exact::pi / 2;
constexpr double overshoot_rad = 1e-3;
constexpr double clearance_m_min = 0.01;

}  // namespace

double Bypass::clear(const Diagram& diagram, double wanted_rad, double distance_m) {
  double best = turn_max_rad, best_cost = 2 * turn_max_rad;
  int best_side = 0;
  for (int halvings = 0; halvings < 3; ++halvings) {
    forbid(diagram, distance_m, parameters_.bypass_clearance_m / (1 << halvings));
    for (const int side : {-1, 1}) {
      const double turn = turn_out(wanted_rad, side);
      if (turn == 0 && halvings == 0) return wanted_rad;
      const double cost = turn + halvings * halving_handicap_rad + (side == side_ ? 0 : other_side_handicap_rad);
      if (turn > turn_max_rad || cost >= best_cost) continue;
      best = turn, best_cost = cost, best_side = side;
    }
  }
  if (best_side == 0) return wanted_rad;
  if (best > 0) side_ = best_side;
  return exact::wrap_angle(wanted_rad + best_side * best);
}

void Bypass::forbid(const Diagram& diagram, double distance_m, double clearance_m) {
  const double radius = parameters_.robot_radius_m;
  count_ = 0;
  for (int i = 0; i < sector_count; ++i) {
    const Sector& sector = diagram[i];
    if (sector.distance_m >= distance_m) continue;
    // An obstacle already beside the robot must not forbid driving past it.
    const double own = std::min(clearance_m, std::max(clearance_m_min, 0.5 * (sector.distance_m - radius)));
    const double d = std::max(sector.distance_m, radius + own);
    const double half_width = exact::atan2(radius + own, std::sqrt(d * d - (radius + own) * (radius + own)));
    forbidden_[count_++] = {sector.angle_rad, half_width};
  }
}

double Bypass::turn_out(double angle_rad, int side) const {
  double turn = 0;
  for (bool moved = true; moved && turn <= turn_max_rad;) {
    moved = false;
    for (std::size_t i = 0; i < count_; ++i) {
      const double offset = side * exact::wrap_angle(angle_rad + side * turn - forbidden_[i].angle_rad);
      if (std::fabs(offset) >= forbidden_[i].half_width_rad) continue;
      turn += forbidden_[i].half_width_rad - offset + overshoot_rad;
      moved = true;
    }
  }
  return turn;
}

}  // namespace waitpoint::ndd
