// SPDX-License-Identifier: BSD-3-Clause
#include "world/arc.hpp"

namespace waitpoint::world {

Pose Arc::at(double fraction) const {
  const double d = fraction * distance_m, turn = fraction * turn_rad;
  const bool straight = turn == 0;
  const double half = 0.5 * turn, shortening = straight ? 1 : exact::sin(half) / half;
  const auto [s, c] = exact::sincos(straight ? start.heading : start.heading + half);
  const double ahead = d * shortening;
  Pose pose = {start.x + ahead * c, start.y + ahead * s,
               straight ? start.heading : exact::wrap_angle(start.heading + turn)};
  if (side_m != 0) {
    const double aside = fraction * side_m * shortening;
    pose.x -= aside * s;
    pose.y += aside * c;
  }
  return pose;
}

Arc Arc::between(const Pose& start, Point moved, double turn_rad, double climb_m) {
  const double turn = exact::wrap_angle(turn_rad), half = 0.5 * turn;
  const double shortening = half == 0 ? 1 : exact::sin(half) / half;
  const auto [s, c] = exact::sincos(start.heading + half);
  return {start, (c * moved.x + s * moved.y) / shortening, turn, (c * moved.y - s * moved.x) / shortening, climb_m};
}

}  // namespace waitpoint::world
