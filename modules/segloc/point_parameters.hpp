// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the map of points (point_map.hpp). The defaults suit a SICK LMS and raw wheel odometry in a building.
#pragma once

#include <cstdint>

#include "core/fields.hpp"
#include "modules/genom/settings.hpp"

namespace waitpoint::segloc {

struct PointParameters {
  bool from_start = false;
  double cell_m = 0.05;
  double reach_m = 0.3;
  double range_m_max = 20;

  double key_travel_m = 0.3;
  double key_turn_rad = 0.3;
  std::uint32_t submap_keys = 20;

  double odometry_m = 0.01, odometry_rad = 0.05;
  double odometry_share = 0.1, odometry_turn_share = 0.3;

  double explained_min = 0.55;
  double point_worth = 0.8;
  double trusted_min = 0.25;
  double contradicted_max = 0.35;
  std::uint32_t lost_scans = 4;
  double lost_m = 1.5;
  double match_m = 0.01, match_rad = 0.004;

  double drift_m_per_m = 0.03;
  double doubt_m = 0.1;
  double search_m_min = 0.5, search_m_max = 5;
  double closure_score_min = 0.55;
  double closure_explained_min = 0.65;
  double found_explained_min = 0.75;
  double rival_share = 0.9;
  double agree_m = 0.3, agree_rad = 0.06;

  static void fields(auto field) {
    using P = PointParameters;
    field("from_start", &P::from_start, "from the first scan on, in place of segments; true where a log is replayed");
    field("cell_m", &P::cell_m, "of the grids that scans are matched with");
    field("reach_m", &P::reach_m, "greatest distance of a point from the map that pulls at it");
    field("range_m_max", &P::range_m_max, "farther echoes are not used");
    field("key_travel_m", &P::key_travel_m, "a scan is kept as a key scan after so much travel,");
    field("key_turn_rad", &P::key_turn_rad, "or so much turn");
    field("submap_keys", &P::submap_keys, "key scans of a sub-map; the next one begins at half of them");
    field("odometry_m", &P::odometry_m, "standard deviation of the odometry's travel between two scans,");
    field("odometry_rad", &P::odometry_rad, "and of its turn,");
    field("odometry_share", &P::odometry_share, "and this share of the travel,");
    field("odometry_turn_share", &P::odometry_turn_share, "and of the turn");
    field("contradicted_max", &P::contradicted_max, "likewise above this share of points where free space was seen");
    field("lost_scans", &P::lost_scans,
          "so many such scans in a row: the robot is lost until closures confirm where it is");
    field("lost_m", &P::lost_m, "after so much travel without a match a sub-map begins that the odometry alone holds");
    field("explained_min", &P::explained_min,
          "least share of a scan's points that the sub-map explains; below, its surroundings are searched");
    field("point_worth", &P::point_worth, "of an explained point, against half a squared deviation from the odometry");
    field("trusted_min", &P::trusted_min, "below this the odometry is used instead, and the scan is no key scan");
    field("match_m", &P::match_m, "least standard deviation of a match");
    field("match_rad", &P::match_rad, "the same of its heading");
    field("drift_m_per_m", &P::drift_m_per_m,
          "drift assumed in a loop, which sets how far is searched for its closure");
    field("doubt_m", &P::doubt_m, "added to the drift where old key scans are near and none matches");
    field("search_m_min", &P::search_m_min, "least distance that is searched for a closure");
    field("search_m_max", &P::search_m_max, "greatest distance");
    field("closure_score_min", &P::closure_score_min, "least score of a closure, from 0 to 1");
    field("closure_explained_min", &P::closure_explained_min, "least share of points that a closure explains");
    field("found_explained_min", &P::found_explained_min, "after a loss, on the whole map");
    field("rival_share", &P::rival_share, "a closure is ambiguous if another place has this share of its score");
    field("agree_m", &P::agree_m, "of two large corrections that confirm each other");
    field("agree_rad", &P::agree_rad, "the same of their turns");
  }
};

/// Those of `points`. Throws BadInput at the setting for values out of range.
PointParameters read_point_parameters(genom::Settings& settings);

}  // namespace waitpoint::segloc
