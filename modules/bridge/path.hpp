// SPDX-License-Identifier: BSD-3-Clause
// The paths of a robot, sampled at 10 Hz from outside the run: samples are events of no task.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::bridge {

struct DatedPose {
  Time date;
  Pose pose;
};

enum class PathKind : std::uint8_t {
  truth,     ///< of the world
  estimate,  ///< the fused position
  odometry,  ///< the odometry alone
};

/// One value for each kind of path.
template <class T>
class PerPath {
 public:
  T& operator[](PathKind kind) { return values_[static_cast<std::size_t>(kind)]; }
  const T& operator[](PathKind kind) const { return values_[static_cast<std::size_t>(kind)]; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }

 private:
  std::array<T, 3> values_{};
};

/// Receives the samples of one robot's paths, those of each kind in the order of their dates.
class PathSink {
 public:
  virtual ~PathSink() = default;
  /// Called during the run: must not change it or throw.
  virtual void add(PathKind kind, const DatedPose& sample) = 0;
};

}  // namespace waitpoint::bridge
