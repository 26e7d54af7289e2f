// SPDX-License-Identifier: BSD-3-Clause
// The bag of a scenario that plays one to nodes of ROS, in the place of a world:
//
//   play: {bag: office.bag, topics: [/scan, /tf], start_s: 10, duration_s: 60, rate: 2, outputs: [map.txt]}
//   launch: mapper.launch
//   nodes:
//     - {name: mapper, command: [nodes/mapper]}
#pragma once

#include "modules/scenario/keys.hpp"
#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

const Keys<PlayScenario>& play_keys();
/// Does not open the bag. BadInput for values out of range.
PlayScenario read_play(const YamlNode& node);

}  // namespace waitpoint::scenario
