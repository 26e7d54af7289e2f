// SPDX-License-Identifier: BSD-3-Clause
// The programs of a scenario's nodes.
#pragma once

#include <vector>

#include "modules/nodes/node_processes.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// Of all nodes of the scenario, in their order. BadInput for a package or an executable that is not found.
std::vector<nodes::NodeCommand> node_commands(const scenario::Scenario& scenario);

}  // namespace waitpoint::tools
