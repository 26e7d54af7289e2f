// SPDX-License-Identifier: BSD-3-Clause
// The module of segment-based localisation and mapping.
//
//   reads    sick.segments, rflex.odometry
//   writes   segloc.localisation (the pose at the date of the scan used), segloc.map
//   requests Localise: from a known pose, until interrupted; the map starts empty. Stop ends it.
#pragma once

#include <optional>

#include "modules/genom/module.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"
#include "modules/segloc/segment_map_filter.hpp"

namespace waitpoint::segloc {

class Segloc : public genom::Module {
 public:
  explicit Segloc(genom::ModuleSetup& setup);

 private:
  static Parameters read(genom::Settings& settings);
  void start(const posters::KnownPose& input);
  void localise();
  void export_map();

  Parameters parameters_;
  genom::ExecutionTask& slam_;
  genom::PosterLink<posters::Segments>& segments_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::OutputPoster<posters::Localisation>& localisation_;
  genom::OutputPoster<posters::SegmentMap>& map_poster_;
  std::optional<SegmentMapFilter> filter_;
  posters::OdometryTrail trail_;
  std::optional<Pose> odometry_at_filter_;  // odometry at the filter's last prediction
  posters::Segments scan_;
  posters::SegmentMap map_;
  std::uint32_t number_ = 0;  // number of the last scan used
  std::uint32_t scans_ = 0;   // number of scans used
};

}  // namespace waitpoint::segloc
