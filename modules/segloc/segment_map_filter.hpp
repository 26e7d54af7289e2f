// SPDX-License-Identifier: BSD-3-Clause
// Simultaneous localisation and mapping on line segments by an extended Kalman filter.
//
//   state       x  y  heading | angle offset | angle offset | ...       the pose, then two variables a landmark
//   covariance  one matrix over all of it (covariance.hpp)
//
// The map starts empty and comes from the segments of the scans alone; its frame is that of the first pose. A scan's
// segments are matched, longest first, each tested jointly with the matches before it; what no landmark explains and
// keeps being seen becomes a landmark; landmarks that prove to be one line become one. The number of landmarks is
// bounded: where there is no room the least worthy one that is out of sight is forgotten.
//
// Scans taken from one place share their systematic errors (a wall's raster cells, the laser's bias), which a Kalman
// filter would average away as if they were noise. So the map is corrected once every bit of way only, and the noise of
// an observation has a floor.
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

namespace waitpoint::segloc {

struct Parameters {
  std::uint32_t landmarks_max = 200;
  std::uint32_t matches_max = 24;  ///< lines that one update takes in

  // Added to the covariance of the odometry: its systematic errors, as the random walk that covers them over some
  // metres (1 % of the way, 0.5 degrees a metre, 1.5 % of the turn).
  double travel_noise_m_per_sqrt_m = 0.02;
  double drift_noise_rad_per_sqrt_m = 0.015;
  double turn_noise_rad_per_sqrt_rad = 0.02;

  // Floor of an observation's standard deviation.
  double angle_floor_rad = 0.005;
  double offset_floor_m = 0.012;

  // The map is corrected when the robot has moved so far, or turned, or stood still for so many scans.
  double update_travel_m = 0.1;
  double update_turn_rad = 0.06;
  std::uint32_t update_scans = 10;

  double chi2_match = 9.21;        ///< of a match; 99 % of the right ones at two degrees of freedom
  double angle_rad_max = 0.15;     ///< matches and duplicates are looked for within
  double offset_m_max = 0.5;
  double gap_m_max = 1.5;          ///< between what is seen and what was seen of a landmark before
  double information_min = 0.1;    ///< matches that teach less, relative to their noise, are left out of the update
  double disputed_offset_m = 0.15; ///< a segment so near a landmark that it does not match is no new line
  double length_m_min = 0.5;       ///< of a segment that is used
  double length_at_once_m = 1.0;   ///< of a new line that becomes a landmark unconfirmed, see consider_new()
  double join_m = 0.3;             ///< gap between two stretches of a wall that is closed
  double chi2_merge = 5.99;        ///< between two landmarks that are one line

  // The robot slipped, if so many updates in a row find fewer matches than segments near a landmark that do not match.
  // The pose is then less sure than thought, and nothing new is learnt until the matches are back or it takes too long.
  std::uint32_t lost_updates = 2, lost_updates_max = 20;
  double lost_noise_m = 0.1, lost_noise_rad = 0.05;
  CandidateParameters candidates;

  static constexpr auto fields() {
    using P = Parameters;
    return std::tuple(
        field("landmarks_max", &P::landmarks_max), field("matches_max", &P::matches_max),
        field("travel_noise_m_per_sqrt_m", &P::travel_noise_m_per_sqrt_m),
        field("drift_noise_rad_per_sqrt_m", &P::drift_noise_rad_per_sqrt_m),
        field("turn_noise_rad_per_sqrt_rad", &P::turn_noise_rad_per_sqrt_rad),
        field("angle_floor_rad", &P::angle_floor_rad), field("offset_floor_m", &P::offset_floor_m),
        field("update_travel_m", &P::update_travel_m), field("update_turn_rad", &P::update_turn_rad),
        field("update_scans", &P::update_scans), field("chi2_match", &P::chi2_match),
        field("angle_rad_max", &P::angle_rad_max), field("offset_m_max", &P::offset_m_max),
        field("gap_m_max", &P::gap_m_max), field("information_min", &P::information_min),
        field("disputed_offset_m", &P::disputed_offset_m), field("length_m_min", &P::length_m_min),
        field("length_at_once_m", &P::length_at_once_m), field("join_m", &P::join_m), field("chi2_merge", &P::chi2_merge), field("lost_updates", &P::lost_updates),
        field("lost_updates_max", &P::lost_updates_max), field("lost_noise_m", &P::lost_noise_m),
        field("lost_noise_rad", &P::lost_noise_rad),
        field("candidates", &P::candidates));
  }
};

/// A pose with its covariance of (x, y, heading) in row order; m^2, m rad, rad^2.
struct PoseEstimate {
  Pose pose;
  std::array<double, 9> covariance{};
};

/// What became of one scan.
struct Observed {
  std::uint32_t segments = 0;  ///< long enough to be used
  std::uint32_t matched = 0;   ///< to landmarks
  std::uint32_t used = 0;      ///< of the matched ones, taken into the state; 0 where the scan was passed over
  std::uint32_t strayed = 0;   ///< not matched, though a landmark is within the bounds where one is looked for
  std::uint32_t added = 0, merged = 0, forgotten = 0;  ///< landmarks
};

class SegmentMapFilter {
 public:
  SegmentMapFilter(const Parameters& parameters, const PoseEstimate& start);

  /// Moves the robot by what the odometry measured: the new pose in the frame of the old one, with its covariance.
  void predict(const PoseEstimate& motion);

  /// Takes in the segments of a scan made at the present pose. Where the robot has hardly moved since the last scan
  /// taken in, this does nothing and returns what became of that one, with `used` 0.
  Observed observe(const posters::Segments& segments);

  PoseEstimate position() const;

  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  const Covariance& covariance() const { return covariance_; }

  /// Writes the map's stretches, as many as the poster holds, each counter-clockwise as seen from where it was seen.
  void export_map(posters::SegmentMap& map) const;

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Match {
    std::size_t landmark = none;  ///< the one that fits best among those that fit
    RowPair rows;
    double information = 0;
    bool strayed = false;   ///< a landmark is near that does not fit
    bool disputed = false;  ///< so near that the segment is no new line
  };
  static std::size_t column_of(std::size_t landmark) { return 3 + 2 * landmark; }

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
  std::vector<Landmark> landmarks_;
  Covariance covariance_;
  JointUpdate joint_;
  Candidates candidates_;

  std::uint64_t update_ = 0;
  double travel_m_ = 0, turn_rad_ = 0;  ///< since the last update
  std::uint32_t scans_ = 0;             ///< since the last update
  std::uint32_t lost_ = 0;              ///< updates in a row with fewer matches than strays
  Observed last_;

  std::vector<LineObservation> observations_;
  std::vector<std::size_t> matched_, unexplained_;  ///< of them
};

}  // namespace waitpoint::segloc
