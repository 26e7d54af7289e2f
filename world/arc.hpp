// SPDX-License-Identifier: BSD-3-Clause
// What a body does within one world step: its velocity is constant, so its path is a circular arc, kept as such.
//
//   pose(f) = start (+) (d sinc(a/2) cos(a/2), d sinc(a/2) sin(a/2), a)      d = f distance, a = f turn
//
// The chord form is exact for every turn, the straight line included, and at(1) of one arc is where the next one
// starts.
#pragma once

#include "core/fields.hpp"
#include "core/pose.hpp"

namespace waitpoint::world {

/// The velocity of a body that moves along its own x axis and turns about its own origin.
struct Velocity {
  double v_m_s = 0, w_rad_s = 0;

  friend constexpr bool operator==(const Velocity&, const Velocity&) = default;
  static constexpr auto fields() {
    return std::tuple(field("v_m_s", &Velocity::v_m_s), field("w_rad_s", &Velocity::w_rad_s));
  }
};

/// A motion at constant velocity: `distance_m` along the path (negative backwards) while turning by `turn_rad`.
struct Arc {
  Pose start;
  double distance_m = 0, turn_rad = 0;

  friend constexpr bool operator==(const Arc&, const Arc&) = default;

  /// The pose after a fraction of the arc, in [0, 1]. The heading is wrapped to (-pi, pi].
  Pose at(double fraction) const;
  Pose end() const { return at(1); }
  /// The arc up to that fraction.
  Arc until(double fraction) const { return {start, fraction * distance_m, fraction * turn_rad}; }

  static constexpr auto fields() {
    return std::tuple(field("start", &Arc::start), field("distance_m", &Arc::distance_m),
                      field("turn_rad", &Arc::turn_rad));
  }
};

}  // namespace waitpoint::world
