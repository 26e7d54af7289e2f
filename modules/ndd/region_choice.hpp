// SPDX-License-Identifier: BSD-3-Clause
// Which way to go: to the goal if it can be reached, else through the opening nearest to it that can be.
//
// An opening is an edge of a region whose gap ascends into it; its sub-goal lies behind the obstacle point at that
// edge. Openings are tried outwards from the goal's direction, to the left and to the right. Of two that are about as
// good, the one chosen before is kept, else the right-hand one is taken: robots that meet head-on then pass each other.
#pragma once

#include <optional>

#include "modules/ndd/regions.hpp"

namespace waitpoint::ndd {

struct Choice {
  bool found = false;           ///< false: no opening can be reached
  bool goal_reachable = false;  ///< the goal itself is the target, and lies in `region`
  Region region;
  bool at_right_edge = false;  ///< the opening is the region's right edge
  Point target;                ///< the goal or the sub-goal, in the robot's frame
};

/// Whether a disc of `robot_width_m` can be expected to get from the origin to `target`, by the obstacle points in the
/// rectangle between them, one robot's width to either side: none within half a width of the target, and no left one
/// closer than a width to a right one. (Sufficient in practice, no proof: the motion law keeps the robot safe.)
bool reachable(const Diagram& diagram, Point target, double robot_width_m);

/// `previous` is the target of the last choice in the present frame, if there was one.
Choice choose_region(const Diagram& diagram, const Regions& regions, Point goal, std::optional<Point> previous,
                     double robot_width_m);

}  // namespace waitpoint::ndd
