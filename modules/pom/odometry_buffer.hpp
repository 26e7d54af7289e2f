// SPDX-License-Identifier: BSD-3-Clause
// The recent past of dead reckoning: a ring of dated poses with cumulative covariances, in the order of their dates.
#pragma once

#include <vector>

#include "core/time.hpp"
#include "modules/pom/uncertain_pose.hpp"

namespace waitpoint::pom {

class OdometryBuffer {
 public:
  /// Holds up to `capacity` poses, at least 2.
  explicit OdometryBuffer(std::size_t capacity);

  /// Inserts a pose at its date, dropping the oldest one if full. One that is older than all of a full buffer, or of a
  /// date already there, is ignored.
  void add(Time date, const UncertainPose& pose);

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  bool full() const { return count_ == ring_.size(); }
  /// Dates of the ends, and of the second-oldest; an empty buffer (or one of one pose) is a bug.
  Time oldest() const { return at_index(0).date; }
  Time second_oldest() const { return at_index(1).date; }
  Time newest() const { return at_index(count_ - 1).date; }

  /// Dead reckoning at a date within the buffer, interpolated along the motion. Up to `horizon` beyond the newest pose
  /// the last motion goes on; farther out, and before the oldest pose, the end stands.
  UncertainPose at(Time date, Duration horizon = Duration()) const;

  /// The motion from one date to a later one, in the frame of the first.
  UncertainPose motion(Time from, Time to, Duration horizon = Duration()) const;

 private:
  struct Dated {
    Time date;
    UncertainPose estimate;
  };
  const Dated& at_index(std::size_t i) const;
  Dated& at_index(std::size_t i) { return const_cast<Dated&>(static_cast<const OdometryBuffer*>(this)->at_index(i)); }

  std::vector<Dated> ring_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace waitpoint::pom
