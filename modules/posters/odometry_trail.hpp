// SPDX-License-Identifier: BSD-3-Clause
// Recent odometry: a ring of dated poses, to locate a scan dated in the past.
#pragma once

#include <cstddef>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::posters {

class OdometryTrail {
 public:
  /// Appends a pose; ignored unless newer than the newest.
  void add(Time date, const Pose& pose);

  bool empty() const { return count_ == 0; }
  /// The newest pose; an empty trail is a bug.
  const Pose& newest() const;
  /// The pose at a date, interpolated; clamped to the oldest and newest one. An empty trail is a bug.
  Pose at(Time date) const;

 private:
  struct Dated {
    Time date;
    Pose pose;
  };
  static constexpr std::size_t capacity = 64;  // more than a second at 50 Hz

  /// The i-th newest.
  const Dated& back(std::size_t i) const { return ring_[(next_ + capacity - 1 - i) % capacity]; }

  std::vector<Dated> ring_;  // empty before the first pose
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace waitpoint::posters
