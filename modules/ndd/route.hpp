// SPDX-License-Identifier: BSD-3-Clause
// The via points being followed: which one is next, how far it still is to the last.
//
// An intermediate via point is passed within a tolerance, or when the robot is beyond it (past the line through it at a
// right angle to the leg) and not far: who had to give way need not turn back for it. The last one is never passed.
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint::ndd {

class Route {
 public:
  /// Replaces the route; it starts at `from`. No via points: no route.
  void start(Point from, std::span<const Point> via_points);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }

  /// Passes the via points that a robot at `robot` has reached.
  void advance(Point robot, double via_tolerance_m);

  /// The via point to make for; an empty route is a bug.
  Point target() const;
  bool target_is_last() const { return next_ + 1 == points_.size(); }
  /// The length from `robot` over the via points to the last.
  double remaining_m(Point robot) const;

 private:
  std::vector<Point> points_;  // the start, then the via points
  std::size_t next_ = 0;
};

}  // namespace waitpoint::ndd
