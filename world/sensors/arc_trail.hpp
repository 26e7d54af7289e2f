// SPDX-License-Identifier: BSD-3-Clause
// A body's recent path: the arcs of its last steps, for sensors that measure while it moves.
#pragma once

#include <cstddef>
#include <vector>

#include "world/arc.hpp"

namespace waitpoint::world {

class ArcTrail {
 public:
  /// Reaches `span_s` into the past, in steps of `step_s` seconds. Before the first step the body was at `start`.
  ArcTrail(double span_s, double step_s, const Pose& start);

  /// Adds the arc of the newest step.
  void add(const Arc& arc);
  /// Forgets the past: the body is at `pose` as if it had always been.
  void restart(const Pose& pose);

  /// The pose `age_s` >= 0 before the end of the newest step; ages beyond the span give the oldest pose.
  Pose at(double age_s) const;

 private:
  double step_s_;
  std::size_t newest_ = 0;
  std::vector<Arc> arcs_;  // a ring
};

}  // namespace waitpoint::world
