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

  double travel_noise_m_per_sqrt_m = 0.015;
  double drift_noise_rad_per_sqrt_m = 0.01;
  double turn_noise_rad_per_sqrt_rad = 0.015;

  double travel_scale_deviation = 0.02;
  double turn_scale_deviation = 0.03;
  double drift_deviation_rad_per_m = 0.012;

  double angle_floor_rad = 0.005;
  double offset_floor_m = 0.012;

  double update_travel_m = 0.1;
  double update_turn_rad = 0.06;
  std::uint32_t update_scans = 10;

  double chi2_match = 9.21;
  double angle_rad_max = 0.15;
  double offset_m_max = 0.5;
  double gap_m_max = 1.5;
  double information_min = 0.1;
  double disputed_offset_m = 0.15;
  // On a building's raster map, shorter ones increased the errors of heading and position in
  // most tours: their angles seem more certain than they are.
  double length_m_min = 1.0;
  double length_at_once_m = 1.0;
  double join_m = 0.3;
  double chi2_merge = 5.99;

  // Segments near a landmark that do not match outnumber the matches by at least two: a single one may be a new line.
  std::uint32_t lost_updates = 2, lost_updates_max = 20;
  double lost_noise_m = 0.1, lost_noise_rad = 0.05;
  CandidateParameters candidates;

  static void fields(auto field) {
    using P = Parameters;
    constexpr NumberRange positive{least_nonzero, 1e5, "a positive number"};
    field("landmarks_max", &P::landmarks_max, CountRange{1, 1000}, "on the map");
    field("matches_max", &P::matches_max, CountRange{1, 1000}, "matches used by one update");
    field("travel_noise_m_per_sqrt_m", &P::travel_noise_m_per_sqrt_m,
          "added to the covariance given by the odometry: of travel");
    field("drift_noise_rad_per_sqrt_m", &P::drift_noise_rad_per_sqrt_m, "random error of its heading, by travel");
    field("turn_noise_rad_per_sqrt_rad", &P::turn_noise_rad_per_sqrt_rad, "random error of its heading, by turns");
    field("travel_scale_deviation", &P::travel_scale_deviation,
          "initial standard deviation of the odometry's scale of travel; 0: no such error");
    field("turn_scale_deviation", &P::turn_scale_deviation, "the same of its scale of turns");
    field("drift_deviation_rad_per_m", &P::drift_deviation_rad_per_m, "the same of its drift");
    field("angle_floor_rad", &P::angle_floor_rad, positive, "least standard deviation of an observation");
    field("offset_floor_m", &P::offset_floor_m, positive, "least standard deviation of an observation");
    field("update_travel_m", &P::update_travel_m, "the map is updated after so much travel,");
    field("update_turn_rad", &P::update_turn_rad, "or so much turn,");
    field("update_scans", &P::update_scans, "or so many scans at rest");
    field("chi2_match", &P::chi2_match, "bound for a match: 99 % of the correct ones, two degrees of freedom");
    field("angle_rad_max", &P::angle_rad_max, "search range for matches and duplicates");
    field("offset_m_max", &P::offset_m_max, "the same for offsets");
    field("gap_m_max", &P::gap_m_max, "between an observation and the landmark's known stretches");
    field("information_min", &P::information_min,
          "matches with less information, relative to their noise, are not used in the update");
    field("disputed_offset_m", &P::disputed_offset_m,
          "a segment this close to a landmark that does not match it is not a new line");
    field("length_m_min", &P::length_m_min, "least length of a segment");
    field("length_at_once_m", &P::length_at_once_m, "least length of an unconfirmed landmark, see consider_new()");
    field("join_m", &P::join_m, "gaps between stretches up to this are closed");
    field("chi2_merge", &P::chi2_merge, "bound for two landmarks that are one line");
    field("lost_updates", &P::lost_updates,
          "the robot has slipped if in so many consecutive updates unmatched segments outnumber the matches");
    field("lost_updates_max", &P::lost_updates_max,
          "then nothing is added to the map until matches return, or for so many updates");
    field("lost_noise_m", &P::lost_noise_m, "the position of a robot that has slipped is uncertain by this,");
    field("lost_noise_rad", &P::lost_noise_rad, "its heading by this");
    field("candidates", &P::candidates, "lines that are not yet on the map");
  }
};

}  // namespace waitpoint::segloc
