// SPDX-License-Identifier: BSD-3-Clause
// What of a scenario's world nodes see, as topics and frames.
#pragma once

#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/nodes/node_side.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::nodes {

/// Indices of the scenario's robots that have nodes.
std::vector<std::size_t> robots_with_nodes(const scenario::Scenario& scenario);

/// Of those robots; `map` is what the first one knows. One laser has the topic `scan`, several have their names;
/// sonars have the topic `sonar`.
NodeSideSetup node_side_setup(const scenario::Scenario& scenario, const OccupancyGrid& map);

Place place_of(const Pose& pose, double z = 0);

}  // namespace waitpoint::nodes
