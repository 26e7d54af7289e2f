// SPDX-License-Identifier: BSD-3-Clause
// Logs of CARMEN, and of GMapping (gfs), which has records of its own. A record is a line of words:
//
//   FLASER n r1 ... rn  x y theta  odom_x odom_y odom_theta  time host logger_time        (RLASER: of the rear laser)
//   ROBOTLASER1 type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode n r1 ... rn
//     m e1 ... em  laser_x laser_y laser_theta  robot_x robot_y robot_theta  tv rv forward side axis
//     time host logger_time
//   RAWLASER1 (as ROBOTLASER1, without poses and the rest)
//   ODOM x y theta tv rv accel time host logger_time
//   PARAM name value ...
//   LASER_READING n r1 ... rn x y theta time    ODOM x y theta time        (gfs)
//
// Lasers whose records have no angles are those of CARMEN: beam i at -90 degrees plus i steps, of 1 degree up to 181
// beams, of 0.5 up to 361, else 180 degrees / (n - 1); readings from 80 m on are no echoes. The laser's pose on the
// robot is that between the two poses of its records if it is the same in all, or else PARAM robot_frontlaser_offset,
// _side_offset and _angular_offset. Other records are left out, and counted.
#pragma once

#include <string_view>

#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

/// BadInput, with the line, for a record that is cut off or has something else in the place of a number, or one
/// beyond its limit (limits.hpp); for a log without scans; for scans of several hosts unless `choice` names one.
SensorLog parse_carmen_log(const std::string& name, std::string_view text, const LogChoice& choice);

}  // namespace waitpoint::logs
