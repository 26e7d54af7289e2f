// SPDX-License-Identifier: BSD-3-Clause
// Parameters of localisation on a known map. The defaults suit a SICK LMS and raw wheel odometry in a building.
#pragma once

#include "core/fields.hpp"
#include "modules/matching/refinement.hpp"
#include "modules/matching/surface.hpp"

namespace waitpoint::locate {

struct TrackingParameters {
  double travel_noise_m_per_sqrt_m = 0.03;
  double drift_noise_rad_per_sqrt_m = 0.03;
  double turn_noise_rad_per_sqrt_rad = 0.04;
  double independent_share = 0.1;
  double position_floor_m = 0.01;
  double heading_floor_rad = 0.004;
  double explained_min = 0.4;
  std::uint32_t lost_scans = 10;
  std::uint32_t rest_scans = 5;
  double rest_m = 0.02, rest_rad = 0.01;

  static void fields(auto field) {
    using P = TrackingParameters;
    field("travel_noise_m_per_sqrt_m", &P::travel_noise_m_per_sqrt_m, "random error of the odometry's travel");
    field("drift_noise_rad_per_sqrt_m", &P::drift_noise_rad_per_sqrt_m, "random error of its heading, by travel");
    field("turn_noise_rad_per_sqrt_rad", &P::turn_noise_rad_per_sqrt_rad, "random error of its heading, by turns");
    field("independent_share", &P::independent_share,
          "of a scan's echoes, by whose number the information of all counts: neighbours share the errors of the wall "
          "and its cells");
    field("position_floor_m", &P::position_floor_m, "least standard deviation of the position");
    field("heading_floor_rad", &P::heading_floor_rad, "least standard deviation of the heading");
    field("explained_min", &P::explained_min, "share of the echoes that the map must explain for a scan to be used");
    field("lost_scans", &P::lost_scans, "consecutive scans below it after which the robot is lost");
    field("rest_scans", &P::rest_scans, "a robot at rest uses every so many scans");
    field("rest_m", &P::rest_m, "a robot is at rest that moved less than this between two scans,");
    field("rest_rad", &P::rest_rad, "and turned less than this");
  }
};

struct FindingParameters {
  double view_turn_rad = 0.35;
  double view_travel_m = 0.4;
  std::uint32_t views_min = 10;
  std::uint32_t views_max = 30;
  double score_min = 0.5;
  double rival_share = 0.9;
  double explained_min = 0.75;

  static void fields(auto field) {
    using P = FindingParameters;
    field("view_turn_rad", &P::view_turn_rad, "a scan is added to the panorama after so much turn,");
    field("view_travel_m", &P::view_travel_m, "or travel");
    field("views_min", &P::views_min, "of a panorama that is searched for");
    field("views_max", &P::views_max, "beyond them, the oldest view is forgotten");
    field("score_min", &P::score_min, "of a place: the mean score of the panorama's points, from 0 to 1");
    field("rival_share", &P::rival_share, "a place is ambiguous if the map explains this share as much at another");
    field("explained_min", &P::explained_min, "share of the panorama that the map explains at the place");
  }
};

struct Parameters {
  TrackingParameters tracking;
  FindingParameters finding;

  static void fields(auto field) {
    field("tracking", &Parameters::tracking, "by scans, around the position by the odometry");
    field("finding", &Parameters::finding, "on the whole map, of a robot that is lost");
  }
};

}  // namespace waitpoint::locate
