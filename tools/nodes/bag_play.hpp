// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run` of a scenario that plays a bag to nodes of ROS.
#pragma once

#include <optional>

#include "core/time.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// Reads the bag through. BadInput for a bag, a topic or a node that cannot be played or started.
void check_bag_play(const scenario::Scenario& scenario);

/// Among nodes (simulated_nodes.hpp): starts the master and the nodes, plays, and prints the summary. Returns the exit
/// status: 0, or 1 if a node failed. `seed` is for the summary.
int play_bag(const scenario::Scenario& scenario, std::uint64_t seed, Time limit);

}  // namespace waitpoint::tools
