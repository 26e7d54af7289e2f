// SPDX-License-Identifier: BSD-3-Clause
// The objects that the library makes.
#pragma once

#include <memory>

#include "modules/nodes/bag_side.hpp"
#include "modules/nodes/node_side.hpp"

namespace waitpoint::nodes {

std::unique_ptr<NodeSide> make_node_side(const NodeSideSetup& setup);
std::unique_ptr<BagSide> make_bag_side(const BagSideSetup& setup);

}  // namespace waitpoint::nodes
