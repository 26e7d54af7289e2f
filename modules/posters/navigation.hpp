// SPDX-License-Identifier: BSD-3-Clause
// What an executive asks of the modules, and what they report: the vocabulary that both sides share.
#pragma once

#include "core/fields.hpp"

namespace waitpoint::posters {

inline constexpr std::size_t via_point_count_max = 48;

/// Where a robot is known to be: input of `rflex` SetPos, `pom` SetPos and `segloc` Localise.
struct KnownPose {
  Pose pose;
  double position_deviation_m = 0.01, heading_deviation_rad = 0.005;

  static constexpr auto fields() {
    return std::tuple(field("pose", &KnownPose::pose), field("position_deviation_m", &KnownPose::position_deviation_m),
                      field("heading_deviation_rad", &KnownPose::heading_deviation_rad));
  }
};

/// Input of GoTo: points of the map frame, in order; the last is where to stop.
struct GoToInput {
  Bounded<Point, via_point_count_max> via;

  static constexpr auto fields() { return std::tuple(field("via", &GoToInput::via)); }
};

/// Codes of the reports of GoTo beside GenoM's own.
enum class NavigationReport : std::uint16_t {
  blocked = 100,      ///< no progress for too long
  no_position = 101,  ///< nobody says where the robot is
};

}  // namespace waitpoint::posters
