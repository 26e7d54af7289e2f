// SPDX-License-Identifier: BSD-3-Clause
// The nodes of ROS that are a robot's software: the keys `ros`, `launch` and `nodes` of a robot, and the scenario's
// `ros`.
//
//   ros: {namespace: rackham, tf_prefix: rackham}
//   launch: FILE, or {file: FILE, args: {NAME: VALUE}}
//   nodes:
//     - {name: driver, command: [nodes/driver, --fast], params: {speed_m_s: 0.5}, remap: {cmd_vel: base/cmd_vel}}
//     - {name: rsp, package: robot_state_publisher, type: robot_state_publisher, after: ["topic:/map"], required: true}
//
// The launch file's nodes are before the scenario's. A file may begin with $(find PACKAGE), $(env NAME) or $(optenv
// NAME).
#pragma once

#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

RosScenario read_ros(const YamlNode& node);

/// The three keys of a robot, as they are, for read_nodes(); none if it has none of them.
std::optional<NodesScenario> take_nodes(const YamlMap& robot);

/// `launch` and `nodes` of the scenario itself. BadInput if it has them, but no bag.
void take_nodes_beside_bag(const YamlMap& scenario, Scenario& taking);

/// Reads what was taken of the scenario and for each robot, when all robots are known: with several of them, each one's
/// names are in a namespace of its own. Extends the scenario's fingerprint by the launch files. BadInput, among others,
/// for two nodes or robots of one name in ROS, and if files are confined: nodes are programs.
void read_nodes(Scenario& scenario);

}  // namespace waitpoint::scenario
