// SPDX-License-Identifier: BSD-3-Clause
#include "modules/posters/odometry_trail.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::posters {

void OdometryTrail::add(Time date, const Pose& pose) {
  if (count_ > 0 && date <= back(0).date) return;
  if (ring_.empty()) ring_.resize(capacity);
  ring_[next_] = {date, pose};
  next_ = (next_ + 1) % capacity;
  count_ = std::min(count_ + 1, capacity);
}

const Pose& OdometryTrail::newest() const {
  WAITPOINT_CHECK(count_ > 0, "no odometry yet");
  return back(0).pose;
}

Pose OdometryTrail::at(Time date) const {
  WAITPOINT_CHECK(count_ > 0, "no odometry yet");
  if (date >= back(0).date) return back(0).pose;
  for (std::size_t i = 1; i < count_; ++i) {
    const Dated &before = back(i), &after = back(i - 1);
    if (date < before.date) continue;
    const double fraction =
        static_cast<double>((date - before.date).ns()) / static_cast<double>((after.date - before.date).ns());
    return interpolate(before.pose, after.pose, fraction);
  }
  return back(count_ - 1).pose;
}

}  // namespace waitpoint::posters
