// SPDX-License-Identifier: BSD-3-Clause
// The module of localisation on a known map, by matching scans with it.
//
//   reads    sick.echoes, rflex.odometry; the planner's map
//   writes   locate.localisation (the pose in the map's frame at the date of the scan used)
//   requests Localise: from a known pose, until interrupted. Find: from an unknown pose, until interrupted. Stop ends
//            either.
//
// A robot that is lost, since the map explains its scans no longer, is found again as one whose pose is unknown; it has
// to turn or to drive for that. Meanwhile `localisation.lost` is set; `localisation.jumps` counts the findings.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "modules/genom/module.hpp"
#include "modules/locate/finder.hpp"
#include "modules/locate/tracker.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::locate {

/// The parameters, with those that are set. Throws BadInput at a setting that it cannot work with.
Parameters read_parameters(genom::Settings& settings);

class Locate : public genom::Module {
 public:
  explicit Locate(genom::ModuleSetup& setup);

 private:
  void start(const std::optional<posters::KnownPose>& known);
  void locate();
  void track(const Pose& odometry);
  void find(const Pose& odometry);

  Parameters parameters_;
  std::shared_ptr<const OccupancyGrid> map_;
  genom::ExecutionTask& locating_;
  genom::PosterLink<posters::Echoes>& echoes_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::OutputPoster<posters::Localisation>& localisation_poster_;
  Duration search_cost_us_;
  std::unique_ptr<const MapSurfaces> surfaces_;  // from the first start on
  std::optional<Tracker> tracker_;               // none: the robot is lost
  std::optional<Finder> finder_;
  posters::OdometryTrail trail_;
  std::optional<Pose> odometry_at_tracker_;
  posters::Echoes scan_;
  std::vector<matching::SurfacePoint> points_;
  posters::Localisation localisation_;
  std::uint32_t number_ = 0;  // of the last scan used
};

}  // namespace waitpoint::locate
