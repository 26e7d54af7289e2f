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

}  // namespace waitpoint::world
