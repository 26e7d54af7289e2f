// SPDX-License-Identifier: BSD-3-Clause
// Simultaneous localisation and mapping on line segments by an extended Kalman filter.
//
//   state       x  y  heading | travel turn drift | angle offset | angle offset | ...
//               the pose        the odometry's      two variables per landmark
//                               systematic errors
//   covariance  one matrix over the whole state (covariance.hpp)
//
// The odometry's systematic errors are estimated where there are lines, which reduces drift where there are none.
//
// The map starts empty and is built from the segments of the scans alone; its frame is that of the first pose. A scan's
// segments are matched, longest first, each tested jointly with the matches before it; a line that no landmark explains
// becomes a landmark after repeated sightings; landmarks found to be one line are merged. The number of landmarks is
// bounded: without room, the landmark of least worth out of sight is removed.
//
// Scans from one place share their systematic errors (a wall's raster cells, the laser's bias), which a Kalman filter
// would average away like noise. So the map is updated only after some travel, and an observation's noise has a lower
// bound.
//
// Sources: Smith, Self, Cheeseman 1990; Castellanos, Tardos, "Mobile robot localization and map building" 1999.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/posters/laser.hpp"
#include "modules/segloc/candidates.hpp"
#include "modules/segloc/covariance.hpp"
#include "modules/segloc/joint_update.hpp"
#include "modules/segloc/landmark.hpp"
#include "modules/segloc/parameters.hpp"

namespace waitpoint::segloc {

/// A pose with its covariance of (x, y, heading) in row order; m^2, m rad, rad^2.
struct PoseEstimate {
  Pose pose;
  std::array<double, 9> covariance{};
};

/// Systematic errors of the odometry: measured distances are scaled by 1 + travel, turns by 1 + turn, and the heading
/// turned by drift per metre ahead.
struct OdometryCalibration {
  double travel = 0, turn = 0, drift_rad_per_m = 0;
};

/// The result of one scan.
struct Observed {
  std::uint32_t segments = 0;                          ///< segments of sufficient length
  std::uint32_t matched = 0;                           ///< matched to landmarks
  std::uint32_t used = 0;                              ///< matches used in the update; 0 if the scan was skipped
  std::uint32_t strayed = 0;                           ///< not matched, although a landmark is within the search range
  std::uint32_t added = 0, merged = 0, forgotten = 0;  ///< landmarks
};

class SegmentMapFilter {
 public:
  /// Starts with an empty map at a known pose.
  SegmentMapFilter(const Parameters& parameters, const PoseEstimate& start);

  /// Moves the robot by the odometry's measurement: the new pose in the frame of the old one, with the covariance of
  /// its random errors; the filter adds its own, see the parameters.
  void predict(const PoseEstimate& motion);

  /// Updates with the segments of a scan made at the present pose. If the robot has hardly moved since the last scan
  /// used, does nothing and returns the result of that one, with `used` 0.
  Observed observe(const posters::Segments& segments);

  PoseEstimate position() const;
  /// The segments near landmarks have not matched for so long that the pose must be wrong.
  bool astray() const { return lost_ > parameters_.lost_updates_max; }
  const OdometryCalibration& calibration() const { return calibration_; }

  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  const Covariance& covariance() const { return covariance_; }

  /// Writes the map's stretches, as many as the poster holds, each counter-clockwise as seen from the observed side.
  void export_map(posters::SegmentMap& map) const;

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Match {
    std::size_t landmark = none;  ///< best of the compatible landmarks
    RowPair rows;
    double information = 0;
    bool strayed = false;   ///< an incompatible landmark is near
    bool disputed = false;  ///< so near that the segment is not a new line
  };
  static constexpr std::size_t own_columns = 6;  ///< pose and calibration
  static std::size_t column_of(std::size_t landmark) { return own_columns + 2 * landmark; }

  bool update_due();
  void sort_observations(const posters::Segments& segments);
  RowPair rows_for(const LineObservation& observation, std::size_t landmark) const;
  Match match(const LineObservation& observation);
  void note_sighting(Landmark& landmark, const LineObservation& observation);
  void correct();
  bool held_by_matches(const LineObservation& observation) const;
  void consider_new(const LineObservation& observation, Observed& result);
  void forget_unconfirmed(Observed& result);
  bool make_room(Observed& result);
  void add(const LineObservation& observation, const Landmark& landmark);
  void remove(std::size_t landmark);
  std::uint32_t merge_seen();
  bool try_merge(std::size_t kept, std::size_t other);
  bool lost(const Observed& result);

  Parameters parameters_;
  Pose pose_;
  OdometryCalibration calibration_;
  std::vector<Landmark> landmarks_;
  Covariance covariance_;
  JointUpdate joint_;
  Candidates candidates_;

  std::uint64_t update_ = 0;
  double travel_m_ = 0, turn_rad_ = 0;  ///< since the last update
  std::uint32_t scans_ = 0;             ///< since the last update
  std::uint32_t lost_ = 0;              ///< consecutive updates that indicate a slip
  Observed last_;

  std::vector<LineObservation> observations_;
  std::vector<std::size_t> matched_, unexplained_;  ///< indices into the observations
};

}  // namespace waitpoint::segloc
