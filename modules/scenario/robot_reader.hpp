// SPDX-License-Identifier: BSD-3-Clause
// One robot of a scenario: its type, overridden by its own keys (modules and lasers are merged by name, other lists
// replaced), its start and its goals.
#pragma once

#include "modules/scenario/body_reader.hpp"
#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

/// Reads an element of `robots`. `types` is the map `robot_types`, or null; a robot with all keys of a type needs none.
RobotScenario read_robot(const YamlNode& node, const YamlNode* types);

/// Reads name, type and equipment of an element of `robots`, which may lack start and shape; other keys are not read.
/// Without lasers it has the default one.
RobotScenario read_robot_without_body(const YamlNode& node, const YamlNode* types);

/// Reads an element of `robots_from_map` for the robot `name`. `given` has its start, and the defaults for keys that
/// neither the type nor the element has.
RobotScenario read_robot_of_map(const YamlNode& node, const YamlNode* types, const std::string& name,
                                const BodyReading& given);

/// `name` with invalid characters replaced by '_', and shortened to the maximum length.
std::string fitting_name(const std::string& name);

/// Validates a robot type, whether or not a robot uses it. It must have a shape unless `for_map`: a map may then give
/// the shape.
void check_robot_type(const YamlEntry& type, bool for_map);

}  // namespace waitpoint::scenario
