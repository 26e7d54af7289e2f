// SPDX-License-Identifier: BSD-3-Clause
// A robot type of a scenario, as YAML, from the parameters fitted to a log.
#pragma once

#include <string>

#include "core/pose.hpp"
#include "tools/fit/laser_fit.hpp"
#include "tools/fit/odometry_fit.hpp"

namespace waitpoint::tools {

struct RobotFit {
  std::string name;
  std::string log = {};  ///< its file, for comments
  Pose mount = {};
  double v_max_m_s = 0, w_max_rad_s = 0;  ///< as driven
  OdometryFit odometry = {};
  LaserFit laser = {};
};

/// The text of a file for `robot_types: {include: FILE}`, with the modules and the bridge of the shipped robot. What a
/// log does not have, such as the robot's shape, is that of the shipped robot, and marked by a comment.
std::string robot_type_text(const RobotFit& fit);

}  // namespace waitpoint::tools
