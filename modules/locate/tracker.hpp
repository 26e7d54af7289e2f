// SPDX-License-Identifier: BSD-3-Clause
// Tracking of a pose on a map: predicted by odometry, corrected by each scan's match with the map's surfaces.
//
//   predict   P = A P A' + Q              Q from the way driven (posters/uncertain_pose.hpp)
//   update    argmin |x - predicted|^2 / P + sum of the scan's squared distances from the map (matching/refinement.hpp)
//
// A scan of which the map explains too little is not used, since it matches by chance if at all; after too many of them
// in a row the robot is lost.
#pragma once

#include <span>

#include "modules/locate/parameters.hpp"
#include "modules/matching/surface_map.hpp"
#include "modules/posters/uncertain_pose.hpp"

namespace waitpoint::locate {

class Tracker {
 public:
  /// The map must outlive the tracker.
  Tracker(const matching::SurfaceMap& map, const TrackingParameters& parameters, const posters::UncertainPose& start)
      : map_(map), parameters_(parameters), estimate_(start) {}

  /// Moves the robot by the odometry's measurement: the new pose as seen from the old one.
  void predict(const Pose& motion);
  /// Corrects the pose by a scan in the robot's frame. False: the scan was not used, since the robot is at rest, or the
  /// map does not explain it.
  bool update(std::span<const matching::SurfacePoint> scan);

  const posters::UncertainPose& estimate() const { return estimate_; }
  /// Share of the last scan compared that the map explains.
  double explained() const { return explained_; }
  bool lost() const { return unexplained_ >= parameters_.lost_scans; }

 private:
  const matching::SurfaceMap& map_;
  TrackingParameters parameters_;
  posters::UncertainPose estimate_;
  double travel_m_ = 0, turn_rad_ = 0;  // since the last scan compared
  std::uint32_t rest_ = 0;              // scans left out since then
  std::uint32_t unexplained_ = 0;       // consecutive
  double explained_ = 1;
};

}  // namespace waitpoint::locate
