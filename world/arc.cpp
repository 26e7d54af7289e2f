// SPDX-License-Identifier: BSD-3-Clause
#include "world/arc.hpp"

namespace waitpoint::world {

Pose Arc::at(double fraction) const {
  const double d = fraction * distance_m, turn = fraction * turn_rad;
  if (turn == 0) {
    const auto [s, c] = exact::sincos(start.heading);
    return {start.x + d * c, start.y + d * s, start.heading};
  }
  const double half = 0.5 * turn;
  const auto [s, c] = exact::sincos(start.heading + half);
  const double chord = d * (exact::sin(half) / half);
  return {start.x + chord * c, start.y + chord * s, exact::wrap_angle(start.heading + turn)};
}

}  // namespace waitpoint::world
