// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/played_bag.hpp"
#include "modules/nodes/library/sides.hpp"

namespace waitpoint::nodes {
namespace {

void check_bag(const BagChoice& choice) { PlayedBag(choice).read_through(); }

}  // namespace
}  // namespace waitpoint::nodes

extern "C" [[gnu::visibility("default")]] const waitpoint::nodes::Library waitpoint_nodes_2 = {
    waitpoint::nodes::make_node_side, waitpoint::nodes::check_bag, waitpoint::nodes::make_bag_side};
