// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/arc_trail.hpp"

#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {

ArcTrail::ArcTrail(double span_s, double step_s, const Pose& start)
    : step_s_(step_s), arcs_(static_cast<std::size_t>(std::ceil(span_s / step_s)) + 1, Arc{start, 0, 0}) {
  WAITPOINT_CHECK(step_s > 0 && span_s >= 0, "a trail of arcs has no positive step, or a negative span");
}

void ArcTrail::add(const Arc& arc) {
  newest_ = (newest_ + 1) % arcs_.size();
  WAITPOINT_FAST_CHECK(newest_ < arcs_.size(), "the newest arc is beyond its ring");
  arcs_[newest_] = arc;
}

void ArcTrail::restart(const Pose& pose) {
  for (Arc& arc : arcs_) arc = {pose, 0, 0};
}

Pose ArcTrail::at(double age_s) const {
  WAITPOINT_CHECK(age_s >= 0, "a body's pose is asked for in the future");
  const double steps = age_s / step_s_, whole = std::floor(steps);
  if (whole >= static_cast<double>(arcs_.size())) return arcs_[(newest_ + 1) % arcs_.size()].start;
  const std::size_t back = static_cast<std::size_t>(whole);
  return arcs_[(newest_ + arcs_.size() - back) % arcs_.size()].at(1 - (steps - whole));
}

}  // namespace waitpoint::world
