// SPDX-License-Identifier: BSD-3-Clause
// What is known about a log's laser better than by the log, which may lack it or have it wrong.
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

/// Replaces what the log has by what is given.
void apply(const GivenLaser& laser, SensorLog& log);

}  // namespace waitpoint::logs
