// SPDX-License-Identifier: BSD-3-Clause
// Recent dead reckoning: a ring of dated poses with cumulative covariances, ordered by date.
#pragma once

#include <vector>

#include "core/time.hpp"
#include "modules/posters/uncertain_pose.hpp"

namespace waitpoint::pom {

using posters::UncertainPose;

class OdometryBuffer {
 public:
  /// Capacity in poses, at least 2.
  explicit OdometryBuffer(std::size_t capacity);

  /// Inserts a pose at its date, removing the oldest one if full. Ignored if its date is present already, or if the
  /// buffer is full and the pose is older than all others.
  void add(Time date, const UncertainPose& pose);

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  bool full() const { return count_ == capacity_; }
  /// The dates at the ends, and the second-oldest date; an empty buffer (or one with a single pose) is a bug.
  Time oldest() const { return at_index(0).date; }
  Time second_oldest() const { return at_index(1).date; }
  Time newest() const { return at_index(count_ - 1).date; }

  /// Dead reckoning at a date within the buffer, interpolated along the motion. Up to `horizon` after the newest pose
  /// the last motion is extrapolated; beyond that, and before the oldest pose, the end pose applies.
  UncertainPose at(Time date, Duration horizon = Duration()) const;

  /// The motion between two dates in order, in the frame of the first pose.
  UncertainPose motion(Time from, Time to, Duration horizon = Duration()) const;

 private:
  struct Dated {
    Time date;
    UncertainPose estimate;
  };
  const Dated& at_index(std::size_t i) const;
  Dated& at_index(std::size_t i) { return const_cast<Dated&>(static_cast<const OdometryBuffer*>(this)->at_index(i)); }

  std::size_t capacity_;
  std::vector<Dated> ring_;  // grows to its capacity; first_ is 0 until it is full
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace waitpoint::pom
