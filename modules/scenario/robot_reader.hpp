// SPDX-License-Identifier: BSD-3-Clause
// One robot of a scenario: its type with its own keys laid over it (modules and lasers by their names, other lists as a
// whole), its start and its goals.
#pragma once

#include "modules/scenario/body_reader.hpp"
#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

/// Reads an element of `robots`. `types` is the map `robot_types`, or null; the robot needs none of them if it has all
/// that a type has.
RobotScenario read_robot(const YamlNode& node, const YamlNode* types);

/// Reads an element of `robots_from_map` for the robot of that name, which has what `given` says where its type and the
/// element do not; it starts where `given` does.
RobotScenario read_robot_of_map(const YamlNode& node, const YamlNode* types, const std::string& name,
                                const BodyReading& given);

/// The name with whatever a name must not have replaced by '_', and not too long.
std::string fitting_name(const std::string& name);

/// Reads a robot type, so that one that no robot uses is checked too. It must have a shape unless `for_map`: then a
/// map may give it.
void check_robot_type(const YamlEntry& type, bool for_map);

/// The values under `node`, nested keys and list positions joined by dots behind `prefix`; nulls are left out.
std::vector<Setting> flattened(const YamlNode& node, const std::string& prefix = "");

}  // namespace waitpoint::scenario
