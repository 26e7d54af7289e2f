// SPDX-License-Identifier: BSD-3-Clause
// One robot of a scenario: its type with its own keys laid over it (modules and lasers by their names, other lists as a
// whole), its start and its goals.
#pragma once

#include "modules/bridge/scenario.hpp"
#include "modules/bridge/yaml_reader.hpp"

namespace waitpoint::bridge {

/// Reads an element of `robots`. `types` is the map `robot_types`, or null; the robot needs none of them if it has all
/// that a type has.
RobotScenario read_robot(const YamlNode& node, const YamlNode* types);

/// Reads a robot type, so that one that no robot uses is checked too.
void check_robot_type(const YamlEntry& type);

/// The values under `node`, nested keys and list positions joined by dots behind `prefix`; nulls are left out.
std::vector<Setting> flattened(const YamlNode& node, const std::string& prefix = "");

}  // namespace waitpoint::bridge
