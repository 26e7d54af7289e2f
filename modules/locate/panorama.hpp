// SPDX-License-Identifier: BSD-3-Clause
// The surroundings as seen from several places on a way: scans put together by odometry, which is good enough over the
// few metres, and one turn, that they take. A single scan fits at many places of a building, a panorama at few.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "modules/locate/parameters.hpp"
#include "modules/matching/surface.hpp"

namespace waitpoint::locate {

class Panorama {
 public:
  explicit Panorama(const FindingParameters& parameters) : parameters_(parameters) {}

  /// Adds a scan in the robot's frame, made at a pose of the odometry's frame. False: nothing was added, since the
  /// robot has hardly moved since the last view.
  bool add(const Pose& odometry, std::span<const matching::SurfacePoint> scan);
  void clear() { views_.clear(); }

  std::size_t views() const { return views_.size(); }
  /// The points of all views in the robot's frame at the last one, at most one for each square of `spacing_m`.
  std::vector<matching::SurfacePoint> points(double spacing_m) const;

 private:
  struct View {
    Pose odometry;
    std::vector<matching::SurfacePoint> points;
  };
  FindingParameters parameters_;
  std::deque<View> views_;
};

}  // namespace waitpoint::locate
