// SPDX-License-Identifier: BSD-3-Clause
// Sensors of a robot's own motion other than its wheels: an inertial measurement unit, a position receiver.
#pragma once

#include "core/fields.hpp"

namespace waitpoint::posters {

/// From the device, and published by `rflex`: means since the previous sample, in the robot's frame.
struct Inertial {
  Time date;
  std::uint64_t number = 0;  ///< counts the samples
  double turn_rad_s = 0;
  double ahead_m_s2 = 0, left_m_s2 = 0, up_m_s2 = 0;  ///< at rest: 0, 0, gravity
  double turned_rad = 0;                              ///< integral of the turn rate since the start

  static void fields(auto field) {
    field("date", &Inertial::date);
    field("number", &Inertial::number);
    field("turn_rad_s", &Inertial::turn_rad_s);
    field("ahead_m_s2", &Inertial::ahead_m_s2);
    field("left_m_s2", &Inertial::left_m_s2);
    field("up_m_s2", &Inertial::up_m_s2);
    field("turned_rad", &Inertial::turned_rad);
  }
};

/// From the device, and published by `rflex`: the position of its antenna in the world's frame.
struct PositionFix {
  Time date;
  std::uint64_t number = 0;  ///< counts the fixes
  Point position;
  double height_m = 0;

  static void fields(auto field) {
    field("date", &PositionFix::date);
    field("number", &PositionFix::number);
    field("position", &PositionFix::position);
    field("height_m", &PositionFix::height_m);
  }
};

}  // namespace waitpoint::posters
