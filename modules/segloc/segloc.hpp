// SPDX-License-Identifier: BSD-3-Clause
// The module of segment-based localisation and mapping.
//
//   reads    sick.segments, rflex.odometry; sick.echoes where the segments do not hold the pose
//   writes   segloc.localisation (the pose at the date of the scan used), segloc.map
//   requests Localise: from a known pose, until interrupted; the map starts empty. Stop ends it.
//
// On floors with long walls in view the filter of segments localises, at little cost. Where most scans show fewer than
// two segments of the map, among clutter, or where the robot is lost, the map of points takes over for the rest of the
// activity, beginning with the segments mapped so far.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "modules/genom/module.hpp"
#include "modules/posters/corrected_trajectory.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"
#include "modules/segloc/point_map.hpp"
#include "modules/segloc/segment_map_filter.hpp"

namespace waitpoint::segloc {

class Segloc : public genom::Module, public posters::CorrectedTrajectory {
 public:
  explicit Segloc(genom::ModuleSetup& setup);

  /// Of the map of points; what the filter told before is kept as it was. Empty while the segments hold the pose.
  std::vector<posters::StampedPose> corrected() const override;

 private:
  static Parameters read(genom::Settings& settings);
  void start(const posters::KnownPose& input);
  void localise();
  void use_segments(const Pose& then);
  void use_points(const Pose& then);
  bool held_by_segments(const Observed& observed);
  void change_to_points(bool lost);
  void export_map();
  void export_points();

  Parameters parameters_;
  PointParameters point_parameters_;
  genom::ExecutionTask& slam_;
  genom::PosterLink<posters::Segments>& segments_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::PosterLink<posters::Echoes>& echoes_;
  genom::OutputPoster<posters::Localisation>& localisation_;
  genom::OutputPoster<posters::SegmentMap>& map_poster_;
  std::optional<SegmentMapFilter> filter_;
  std::unique_ptr<PointMap> points_;         // in place of the filter
  double held_ = 1;                          // running share of the scans whose segments hold the pose
  std::vector<posters::StampedPose> early_;  // before the change to points
  std::unique_ptr<posters::Echoes> scan_of_points_;
  std::vector<matching::SurfacePoint> surface_;
  posters::OdometryTrail trail_;
  std::optional<Pose> odometry_at_filter_;  // odometry at the filter's last prediction
  posters::Segments scan_;
  posters::SegmentMap map_;
  std::uint32_t number_ = 0;  // number of the last scan used
  std::uint32_t scans_ = 0;   // number of scans used
};

}  // namespace waitpoint::segloc
