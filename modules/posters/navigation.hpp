// SPDX-License-Identifier: BSD-3-Clause
// Requests of an executive to the modules, and their reports: the types that both sides share.
#pragma once

#include "core/fields.hpp"

namespace waitpoint::posters {

inline constexpr std::size_t via_point_count_max = 48;

/// The robot's known pose: input of `rflex` SetPos, `pom` SetPos and `segloc` Localise.
struct KnownPose {
  Pose pose;
  double position_deviation_m = 0.01, heading_deviation_rad = 0.005;

  static void fields(auto field) {
    field("pose", &KnownPose::pose);
    field("position_deviation_m", &KnownPose::position_deviation_m);
    field("heading_deviation_rad", &KnownPose::heading_deviation_rad);
  }
};

/// Input of `rflex` GotoSpeed.
struct SpeedInput {
  double v_m_s = 0, w_rad_s = 0, side_m_s = 0, climb_m_s = 0;

  static void fields(auto field) {
    field("v_m_s", &SpeedInput::v_m_s);
    field("w_rad_s", &SpeedInput::w_rad_s);
    field("side_m_s", &SpeedInput::side_m_s, added);
    field("climb_m_s", &SpeedInput::climb_m_s, added);
  }
};

/// Input of GoTo and Reroute: points of the map frame in order; the last is the goal.
struct GoToInput {
  Bounded<Point, via_point_count_max> via;

  static void fields(auto field) { field("via", &GoToInput::via); }
};

/// Reports of GoTo in addition to GenoM's standard ones.
enum class NavigationReport : std::uint16_t {
  blocked = 100,      ///< no progress for too long
  no_position = 101,  ///< the robot's position is unknown
  not_driving = 102,  ///< Reroute: there is no active GoTo
};

}  // namespace waitpoint::posters
