// SPDX-License-Identifier: BSD-3-Clause
// The robots of a map file as robots of the scenario: `robots_from_map`.
//
//   robots_from_map: scout                              all of them, with type `scout`
//   robots_from_map: [{model: red, type: scout}, ...]   the first matching row applies: one without `model`, or with
//                                                       the robot's name, or with one of its types in the file
//
// A row may have all keys of a robot but name and start; they override those of its type. For `shape`, `base` and
// `lasers` the file has the defaults. Robots without a matching row are left out.
#pragma once

#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

/// Reads the map file and appends its robots to those of the scenario. BadInput for a row without a robot, a duplicate
/// name, or a scenario without a map.
void read_robots_from_map(const YamlNode& node, const YamlNode* types, Scenario& scenario);

}  // namespace waitpoint::scenario
