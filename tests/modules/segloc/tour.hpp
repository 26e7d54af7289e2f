// SPDX-License-Identifier: BSD-3-Clause
// A robot driven along way points through a synthetic room, with a laser and erroneous odometry, as input of the
// filter.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "modules/segloc/segment_map_filter.hpp"
#include "modules/sick/segment_extraction.hpp"
#include "tests/modules/sick/synthetic_room.hpp"

namespace waitpoint::synthetic {

/// The errors of the wheels' reports: scales, a drift, and noise.
struct OdometryModel {
  double travel_scale = 1.01, turn_scale = 1.015, drift_rad_per_m = 0.0087;
  double travel_noise_m_per_sqrt_m = 0.005;
  double turn_noise_rad_per_sqrt_m = 0.005, turn_noise_rad_per_sqrt_rad = 0.01;
};

/// A disc that moves back and forth between two points.
struct Walker {
  Point from, to;
  double radius_m = 0.25, speed_m_s = 0.4;

  Disc at(double time_s) const;
};

struct TourOptions {
  std::uint64_t seed = 1;
  LaserModel laser;
  Pose mount{0.15, 0, 0};
  OdometryModel odometry;
  double odometry_covariance_scale = 1;  ///< reported noise / true noise; 0: the filter uses its own model
  std::uint64_t slip_scan = 0;           ///< after this scan the robot has moved by `slip`, unnoticed by the odometry
  Pose slip;
  double speed_m_s = 0.5, turn_rad_s = 0.8;
  std::vector<Walker> walkers;
  segloc::Parameters filter;
  sick::SegmentExtractionParameters extraction;
  /// Called after every scan with the time and the true pose.
  std::function<void(double, const Pose&, const segloc::SegmentMapFilter&)> after_scan;
};

struct TourResult {
  double way_m = 0;
  double error_m_max = 0, error_m_mean = 0, error_m_end = 0, heading_error_rad_max = 0;
  double nees_mean = 0;  ///< of the pose, three degrees of freedom
  double odometry_error_m_max = 0, odometry_error_m_end = 0;
  std::size_t landmarks_max = 0, landmarks_end = 0;
  double matched_mean = 0, segments_mean = 0, used_mean = 0;
  std::uint64_t scans = 0, added = 0, merged = 0, forgotten = 0, strayed = 0;
  double observe_us_mean = 0, observe_us_max = 0;
  std::unique_ptr<segloc::SegmentMapFilter> filter;
};

/// Drives from the first way point to the last, facing the second one at first.
TourResult drive(const Room& room, const std::vector<Point>& way, const TourOptions& options);

/// An office floor of 40 m x 30 m: a ring of corridors, rooms with doors along them, furniture; and a way of about 200
/// m through eleven of its rooms, with some corridors travelled repeatedly.
Room office();
std::vector<Point> office_way();
std::vector<Walker> office_walkers();

}  // namespace waitpoint::synthetic
