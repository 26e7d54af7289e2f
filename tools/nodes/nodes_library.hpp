// SPDX-License-Identifier: BSD-3-Clause
// The library with ROS, which is loaded for scenarios with nodes only.
#pragma once

#include "core/location.hpp"
#include "modules/nodes/node_side.hpp"

namespace waitpoint::tools {

/// BadInput at `written`, where the scenario has nodes, if this program was built without.
void check_library(const Location& written);

/// Loaded once. BadInput as above.
const nodes::Library& library_of_nodes(const Location& written);

}  // namespace waitpoint::tools
