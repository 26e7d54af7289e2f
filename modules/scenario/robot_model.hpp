// SPDX-License-Identifier: BSD-3-Clause
// A robot's shape and sensor positions from a URDF file:
//
//   urdf: rover.urdf                       instead of `shape`
//   urdf: {file: rover.urdf.xacro, arguments: {namespace: ""}}
//   lasers: [{frame: laser_link}]          instead of `mount` and `height_m`
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/scenario/yaml_reader.hpp"
#include "world/formats/urdf.hpp"

namespace waitpoint::scenario {

struct RobotModel {
  world::UrdfRobot robot;
  std::vector<std::string> warnings;  ///< parts of the file that are omitted or approximated, one line each
};

/// The model of the key `urdf`: a path relative to the scenario, with values for its arguments of xacro; nothing
/// without the key.
std::optional<RobotModel> read_robot_model(const YamlMap& robot);

/// Mounts a laser at the link named by its `frame`, if it has one. The link must be upright.
void mount_at_frame(const YamlNode& laser, const std::optional<RobotModel>& model, world::LaserDescription& device);

}  // namespace waitpoint::scenario
