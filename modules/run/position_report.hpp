// SPDX-License-Identifier: BSD-3-Clause
// A report of a robot's position by a source outside of the simulation, as words KEY=VALUE:
//
//   x_m=20.4 y_m=4 heading_rad=1.57 v_m_s=0.3 w_rad_s=0.1 side_m_s=0
//
// in the world's frame, and the velocity in the robot's own. A time comes first: by the source's clock (stamp_s), or as
// the date in virtual time (date_s). The time and the pose are necessary; of a given velocity, absent parts are 0.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/pose.hpp"
#include "modules/scenario/location.hpp"
#include "world/arc.hpp"

namespace waitpoint::run {

struct PositionReport {
  double time_s = 0;
  Pose pose;
  std::optional<world::Velocity> velocity;
};

/// Throws BadInput at `written` for an unknown, repeated or missing key, and for a value that is no number within the
/// bounds of its unit: 1e12 s, 1e5 m, 1000 rad, 100 m/s and rad/s. The heading is wrapped.
PositionReport parse_report(std::string_view text, std::string_view time_key, const scenario::Location& written);

/// As parse_report() reads it, with the same bits.
std::string to_text(const PositionReport& report, std::string_view time_key);

}  // namespace waitpoint::run
