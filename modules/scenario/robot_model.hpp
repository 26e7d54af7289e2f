// SPDX-License-Identifier: BSD-3-Clause
// A robot's shape and the places of its sensors from a URDF that a scenario names:
//
//   urdf: rover.urdf                       in place of `shape`
//   lasers: [{frame: laser_link}]          in place of `mount` and `height_m`
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/scenario/yaml_reader.hpp"
#include "world/formats/urdf.hpp"

namespace waitpoint::scenario {

struct RobotModel {
  world::UrdfRobot robot;
  std::vector<std::string> warnings;  ///< what of the file is left out or taken otherwise, a line each
};

/// The model that the key `urdf` names, by a path relative to the scenario; none without the key.
std::optional<RobotModel> read_robot_model(const YamlMap& robot);

/// Puts a laser where a link of the model is, if the scenario's `laser` says so by `frame`. The link must be upright.
void mount_at_frame(const YamlNode& laser, const std::optional<RobotModel>& model, world::LaserDescription& device);

}  // namespace waitpoint::scenario
