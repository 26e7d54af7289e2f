// SPDX-License-Identifier: BSD-3-Clause
// Chooses the way: to the goal if it is reachable, else through the reachable opening nearest to its direction.
//
// An opening is an edge of a region whose gap ascends into it; its sub-goal lies behind the obstacle point at that
// edge. Openings are tried outwards from the goal's direction, to the left and to the right. Of two similar ones the
// previous choice is preferred, then the right-hand one: robots that meet head-on then pass each other.
#pragma once

#include <optional>

#include "modules/ndd/regions.hpp"

namespace waitpoint::ndd {

struct Choice {
  bool found = false;           ///< false: no opening is reachable
  bool goal_reachable = false;  ///< the goal itself is the target, and lies in `region`
  Region region;
  bool at_right_edge = false;  ///< the opening is the region's right edge
  Point target;                ///< the goal or the sub-goal, in the robot's frame
};

/// True if a disc of `robot_width_m` can probably get from the origin to `target`, by the obstacle points in the
/// rectangle between them, one robot's width to either side: none within half a width of the target, and no left one
/// closer than a width to a right one. (Sufficient in practice, not proven: the motion law keeps the robot safe.)
bool reachable(const Diagram& diagram, Point target, double robot_width_m);

/// `previous` is the target of the last choice in the present frame, if any.
Choice choose_region(const Diagram& diagram, const Regions& regions, Point goal, std::optional<Point> previous,
                     double robot_width_m);

}  // namespace waitpoint::ndd
