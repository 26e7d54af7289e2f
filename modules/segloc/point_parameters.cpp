// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/point_parameters.hpp"

#include <string>
#include <utility>

namespace waitpoint::segloc {

PointParameters read_point_parameters(genom::Settings& settings) {
  PointParameters p;
  settings.read_described("points", p, "localisation on the points of scans");
  const auto check = [&](const char* name, double value, double least, double most) {
    settings.check_least(std::string("points.") + name, value, least);
    settings.check_most(std::string("points.") + name, value, most);
  };
  // Cells and what is counted in them: memory and time.
  check("cell_m", p.cell_m, 0.01, 1);
  check("reach_m", p.reach_m, 0.01, 5);
  check("range_m_max", p.range_m_max, 0.1, 1000);
  check("key_travel_m", p.key_travel_m, 0.01, 100);
  check("key_turn_rad", p.key_turn_rad, 0.01, 100);
  check("submap_keys", p.submap_keys, 4, 1000);  // halves of them are counted, beginning at one
  check("search_m_min", p.search_m_min, 0.01, 100);
  check("search_m_max", p.search_m_max, 0.01, 100);
  // Deviations whose inverse squares are weights.
  check("odometry_m", p.odometry_m, 1e-4, 10);
  check("odometry_rad", p.odometry_rad, 1e-4, 10);
  check("match_m", p.match_m, 1e-4, 10);
  check("match_rad", p.match_rad, 1e-4, 10);
  check("lost_scans", p.lost_scans, 1, 1e6);
  const std::pair<const char*, double> shares[] = {{"explained_min", p.explained_min},
                                                   {"trusted_min", p.trusted_min},
                                                   {"contradicted_max", p.contradicted_max},
                                                   {"closure_score_min", p.closure_score_min},
                                                   {"rival_share", p.rival_share},
                                                   {"closure_explained_min", p.closure_explained_min},
                                                   {"found_explained_min", p.found_explained_min}};
  for (const auto& [name, value] : shares) check(name, value, 0, 1);
  const std::pair<const char*, double> others[] = {{"odometry_share", p.odometry_share},
                                                   {"odometry_turn_share", p.odometry_turn_share},
                                                   {"point_worth", p.point_worth},
                                                   {"lost_m", p.lost_m},
                                                   {"drift_m_per_m", p.drift_m_per_m},
                                                   {"doubt_m", p.doubt_m},
                                                   {"agree_m", p.agree_m},
                                                   {"agree_rad", p.agree_rad}};
  for (const auto& [name, value] : others) check(name, value, 0, 1000);
  if (p.search_m_min > p.search_m_max) {
    // At the one that is given: the defaults are in order.
    if (settings.has("points.search_m_min")) check("search_m_min", p.search_m_min, 0, p.search_m_max);
    check("search_m_max", p.search_m_max, p.search_m_min, 100);
  }
  return p;
}

}  // namespace waitpoint::segloc
