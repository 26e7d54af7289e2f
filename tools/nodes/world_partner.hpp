// SPDX-License-Identifier: BSD-3-Clause
// The partner of a run that starts its robots' ROS nodes and is the world to them.
#pragma once

#include <memory>

#include "modules/nodes/shown_topics.hpp"
#include "modules/outside/partner.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// BadInput for a node whose executable is not found, and if this program has no nodes.
void check_nodes(const scenario::Scenario& scenario);

/// Starts the master; the nodes start with the run. `shown` gets the messages of shown topics. BadInput as above.
/// The scenario must outlive it. `is_brief`: see nodes::NodeRunOptions.
std::unique_ptr<outside::Partner> make_world_partner(const scenario::Scenario& scenario,
                                                     std::shared_ptr<nodes::ShownTopics> shown, bool is_brief);

}  // namespace waitpoint::tools
