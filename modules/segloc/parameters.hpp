// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the segment map's filter. The defaults suit a SICK LMS and raw wheel odometry in a building.
#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "modules/segloc/candidates.hpp"

namespace waitpoint::segloc {

struct Parameters {
  std::uint32_t landmarks_max = 200;
  std::uint32_t matches_max = 24;

  // Added to the covariance given by the odometry.
  double travel_noise_m_per_sqrt_m = 0.015;
  double drift_noise_rad_per_sqrt_m = 0.01;
  double turn_noise_rad_per_sqrt_rad = 0.015;

  // Initial standard deviations of the odometry's systematic errors; 0: no such error.
  double travel_scale_deviation = 0.02;
  double turn_scale_deviation = 0.03;
  double drift_deviation_rad_per_m = 0.012;

  // Least standard deviation of an observation.
  double angle_floor_rad = 0.005;
  double offset_floor_m = 0.012;

  // The map is updated after so much travel, or turn, or so many scans at rest.
  double update_travel_m = 0.1;
  double update_turn_rad = 0.06;
  std::uint32_t update_scans = 10;

  double chi2_match = 9.21;
  double angle_rad_max = 0.15;
  double offset_m_max = 0.5;
  double gap_m_max = 1.5;
  double information_min = 0.1;
  double disputed_offset_m = 0.15;
  // Least length of a segment. On a building's raster map, shorter ones increased the errors of heading and position in
  // most tours: their angles seem more certain than they are.
  double length_m_min = 1.0;
  double length_at_once_m = 1.0;
  double join_m = 0.3;
  double chi2_merge = 5.99;

  // The robot has slipped if in so many consecutive updates the segments near a landmark that do not match outnumber
  // the matches (by at least two: a single one may be a new line). The pose is then less certain than estimated, and
  // nothing is added until matches return or lost_updates_max is reached.
  std::uint32_t lost_updates = 2, lost_updates_max = 20;
  double lost_noise_m = 0.1, lost_noise_rad = 0.05;
  CandidateParameters candidates;

  static void fields(auto field) {
    using P = Parameters;
    constexpr NumberRange positive{least_nonzero, 1e5, "a positive number"};
    field("landmarks_max", &P::landmarks_max, CountRange{1, 1000}, "on the map");
    field("matches_max", &P::matches_max, CountRange{1, 1000}, "matches used by one update");
    field("travel_noise_m_per_sqrt_m", &P::travel_noise_m_per_sqrt_m);
    field("drift_noise_rad_per_sqrt_m", &P::drift_noise_rad_per_sqrt_m);
    field("turn_noise_rad_per_sqrt_rad", &P::turn_noise_rad_per_sqrt_rad);
    field("travel_scale_deviation", &P::travel_scale_deviation);
    field("turn_scale_deviation", &P::turn_scale_deviation);
    field("drift_deviation_rad_per_m", &P::drift_deviation_rad_per_m);
    field("angle_floor_rad", &P::angle_floor_rad, positive, "least standard deviation of an observation");
    field("offset_floor_m", &P::offset_floor_m, positive, "least standard deviation of an observation");
    field("update_travel_m", &P::update_travel_m);
    field("update_turn_rad", &P::update_turn_rad);
    field("update_scans", &P::update_scans);
    field("chi2_match", &P::chi2_match, "bound for a match: 99 % of the correct ones, two degrees of freedom");
    field("angle_rad_max", &P::angle_rad_max, "search range for matches and duplicates");
    field("offset_m_max", &P::offset_m_max);
    field("gap_m_max", &P::gap_m_max, "between an observation and the landmark's known stretches");
    field("information_min", &P::information_min,
          "matches with less information, relative to their noise, are not used in the update");
    field("disputed_offset_m", &P::disputed_offset_m,
          "a segment this close to a landmark that does not match it is not a new line");
    field("length_m_min", &P::length_m_min);
    field("length_at_once_m", &P::length_at_once_m, "least length of an unconfirmed landmark, see consider_new()");
    field("join_m", &P::join_m, "gaps between stretches up to this are closed");
    field("chi2_merge", &P::chi2_merge, "bound for two landmarks that are one line");
    field("lost_updates", &P::lost_updates);
    field("lost_updates_max", &P::lost_updates_max);
    field("lost_noise_m", &P::lost_noise_m);
    field("lost_noise_rad", &P::lost_noise_rad);
    field("candidates", &P::candidates);
  }
};

}  // namespace waitpoint::segloc
