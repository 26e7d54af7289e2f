// SPDX-License-Identifier: BSD-3-Clause
// A body's motion within one world step: at constant velocity, so its path is a circular arc.
//
//   pose(f) = start (+) (sinc(a/2) R(a/2) (d, s), a)      d = f distance, s = f side, a = f turn
//
// An aerial body climbs at a constant rate: its path is a helix. The chord form is exact for every turn, including the
// straight line, and at(1) of one arc is the start of the next.
#pragma once

#include <cmath>

#include "core/fields.hpp"
#include "core/pose.hpp"

namespace waitpoint::world {

/// The velocity of a body in its own frame: along its x axis, about its origin, along its y axis (to the left), and
/// upwards. The last two are 0 for bases that cannot move so.
struct Velocity {
  double v_m_s = 0, w_rad_s = 0, side_m_s = 0, climb_m_s = 0;

  friend constexpr bool operator==(const Velocity&, const Velocity&) = default;
  static void fields(auto field) {
    field("v_m_s", &Velocity::v_m_s);
    field("w_rad_s", &Velocity::w_rad_s);
    field("side_m_s", &Velocity::side_m_s, added);
    field("climb_m_s", &Velocity::climb_m_s, added);
  }
};

/// A motion at constant velocity: `distance_m` along the body's x axis (negative backwards) and `side_m` along its y
/// axis while turning by `turn_rad` and rising by `climb_m`.
struct Arc {
  Pose start;
  double distance_m = 0, turn_rad = 0, side_m = 0, climb_m = 0;

  /// From `start`, at constant velocity for `time_s`.
  static Arc of(const Pose& start, const Velocity& velocity, double time_s) {
    return {start, velocity.v_m_s * time_s, velocity.w_rad_s * time_s, velocity.side_m_s * time_s,
            velocity.climb_m_s * time_s};
  }

  /// The arc from `start` that ends at start + moved, with the given turn and climb. Turns beyond half a turn are
  /// wrapped: the shorter turn with the same end.
  static Arc between(const Pose& start, Point moved, double turn_rad, double climb_m);

  friend constexpr bool operator==(const Arc&, const Arc&) = default;

  /// The pose after a fraction of the arc, in [0, 1]. The heading is wrapped to (-pi, pi].
  Pose at(double fraction) const;
  Pose end() const { return at(1); }
  /// The arc up to that fraction.
  Arc until(double fraction) const {
    return {start, fraction * distance_m, fraction * turn_rad, fraction * side_m, fraction * climb_m};
  }
  bool moves() const { return distance_m != 0 || turn_rad != 0 || side_m != 0 || climb_m != 0; }
  /// Length of the path of the body's origin in the plane, and in space.
  double planar_length_m() const { return side_m == 0 ? std::fabs(distance_m) : exact::hypot(distance_m, side_m); }
  double length_m() const { return climb_m == 0 ? planar_length_m() : exact::hypot(planar_length_m(), climb_m); }

  static void fields(auto field) {
    field("start", &Arc::start);
    field("distance_m", &Arc::distance_m);
    field("turn_rad", &Arc::turn_rad);
    field("side_m", &Arc::side_m, added);
    field("climb_m", &Arc::climb_m, added);
  }
};

}  // namespace waitpoint::world
