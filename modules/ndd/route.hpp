// SPDX-License-Identifier: BSD-3-Clause
// The via points of the present route: the next one, and the remaining length.
//
// An intermediate via point is passed within a tolerance, or when the robot is beyond it (past the line through it
// perpendicular to the leg) and close: a robot that had to give way need not turn back for it. Within the tolerance, a
// corner may be cut only if the straight way to the next via point is clear. The last one is never passed.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint::ndd {

class Route {
 public:
  /// Replaces the route; it starts at `from`. Without via points there is no route.
  void start(Point from, std::span<const Point> via_points);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }

  /// Removes the via points that a robot at `robot` has reached. `is_clear` tells of a via point whether the straight
  /// way there is; without it, all are.
  void advance(Point robot, double via_tolerance_m, const std::function<bool(Point)>& is_clear = {});

  /// The next via point; an empty route is a bug.
  Point target() const;
  bool target_is_last() const { return next_ + 1 == points_.size(); }
  /// The via points that the robot has not reached.
  std::span<const Point> ahead() const { return std::span(points_).subspan(empty() ? 0 : next_); }
  /// The length from `robot` over the via points to the last.
  double remaining_m(Point robot) const;

 private:
  std::vector<Point> points_;  // the start, then the via points
  std::size_t next_ = 0;
};

}  // namespace waitpoint::ndd
