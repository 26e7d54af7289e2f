// SPDX-License-Identifier: BSD-3-Clause
// The keys of what a scenario says of nodes of ROS.
#pragma once

#include "modules/scenario/keys.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

inline constexpr std::string_view map_to_odom_words[] = {"truth", "nodes"}, output_words[] = {"log", "screen"},
                                  shown_kinds[] = {"path", "cloud", "grid"};

/// The scenario's `ros`.
const Keys<RosScenario>& ros_keys();
/// A robot's `ros`.
const KeyTable& robot_ros_keys();
const KeyTable& node_keys();
/// A launch file with values of its arguments.
const KeyTable& launch_keys();

/// A name in the graph of ROS.
Json ros_name_schema();
Json launch_schema(SchemaDefinitions& definitions);
Json nodes_schema(SchemaDefinitions& definitions);

}  // namespace waitpoint::scenario
