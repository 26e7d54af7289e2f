// SPDX-License-Identifier: BSD-3-Clause
// Corrections of a log's laser, whose data the log may lack or have wrong.
#pragma once

#include <optional>

#include "core/pose.hpp"
#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

struct GivenLaser {
  std::optional<double> field_of_view_rad = {};  ///< from the first beam to the last, half on either side of the axis
  std::optional<Pose> mount = {};                ///< the laser's pose on the robot
  std::optional<double> range_max_m = {};        ///< readings from here on are no echoes
};

/// Replaces the log's values by the given ones.
void apply(const GivenLaser& laser, SensorLog& log);

}  // namespace waitpoint::logs
