// SPDX-License-Identifier: BSD-3-Clause
// The occupied cells of a grid that a node of ROS has published, as few boxes.
#pragma once

#include <vector>

#include "modules/bridge/run_result.hpp"
#include "modules/nodes/shown_topics.hpp"

namespace waitpoint::tools {

/// A box of no height for each run of occupied cells of a row; none without a grid.
std::vector<world::Shape> occupied_shapes(const nodes::ShownMessage& message);

}  // namespace waitpoint::tools
