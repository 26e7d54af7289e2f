// SPDX-License-Identifier: BSD-3-Clause
// Reads the key `control` of a robot, of a robot type, or of the scenario for all robots.
#pragma once

#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// A file of rules, or a map with the key `rules` and settings of the controller's task. The file is read, not its
/// rules.
ControlScenario read_control(const YamlNode& node);

}  // namespace waitpoint::scenario
