// SPDX-License-Identifier: BSD-3-Clause
// Messages of nodes that are shown, as values of this program.
#pragma once

#include "modules/nodes/node_side.hpp"
#include "modules/nodes/shown_topics.hpp"

namespace waitpoint::nodes {

/// Poses that are no numbers are left out, and a grid whose size is not that of its cells.
ShownMessage message_of(const ShownReading& reading);

}  // namespace waitpoint::nodes
