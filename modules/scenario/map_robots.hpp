// SPDX-License-Identifier: BSD-3-Clause
// The robots that stand in the map's file, as robots of the scenario: `robots_from_map`.
//
//   robots_from_map: scout                              all of them, of that type
//   robots_from_map: [{model: red, type: scout}, ...]   the first row counts that has no `model`, or the robot's name
//   or
//                                                       one of the types that it is made from in the file
//
// A row has what a robot has beside name and start, laid over its type; of `shape`, `base` and `lasers` a robot has
// what the file says where neither says it. What no row is for is left out.
#pragma once

#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

/// Reads the scenario's map, which must be known, and adds its robots to those of the scenario. BadInput where a row is
/// for no robot, and where two robots have one name.
void read_robots_from_map(const YamlNode& node, const YamlNode* types, Scenario& scenario);

}  // namespace waitpoint::scenario
