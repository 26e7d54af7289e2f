// SPDX-License-Identifier: BSD-3-Clause
// The run's own node, and the topics and services that it and the others find at the master.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "modules/nodes/library/used_master.hpp"

namespace waitpoint::nodes {

inline constexpr const char* own_name = "/waitpoint";

/// By global name; no maps. With a clock use_sim_time is set. Before roscpp asks for them.
void set_parameters(UsedMaster& master, bool has_clock,
                    const std::vector<std::pair<std::string, nlohmann::json>>& parameters);
/// From now on, ros::NodeHandle is that of the node.
void start_own_node(const UsedMaster& master);

}  // namespace waitpoint::nodes
