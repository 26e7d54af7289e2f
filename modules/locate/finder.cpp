// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/finder.hpp"

#include <algorithm>
#include <cmath>

#include "modules/locate/map_surface.hpp"

namespace waitpoint::locate {
namespace {

// Of the map for tracking, and of that for searches, whose steps are its cells.
constexpr double fine_cell_m = 0.05, fine_reach_m = 0.4, fine_deviation_m = 0.1;
constexpr double coarse_cell_m = 0.15, coarse_reach_m = 0.45, coarse_deviation_m = 0.15, coarse_arm_m = 4;
constexpr unsigned levels = 7;
constexpr double spacing_m = 0.3;
// Places nearer than these are one.
constexpr double apart_m = 0.3, apart_rad = 0.15;
constexpr double rival_slack = 0.05;
constexpr unsigned peaks_max = 12;
constexpr std::uint32_t openings_max = 1'000'000;

bool are_one(const Pose& a, const Pose& b) {
  return length(a.position() - b.position()) < apart_m &&
         std::fabs(exact::wrap_angle(a.heading - b.heading)) < apart_rad;
}

matching::SurfaceMap of_points(const std::vector<matching::SurfacePoint>& points, double cell_m, double reach_m,
                               double deviation_m) {
  matching::SurfaceMap result(cell_m, reach_m, deviation_m);
  result.add({}, points);
  return result;
}

}  // namespace

MapSurfaces::MapSurfaces(const OccupancyGrid& map) : MapSurfaces(surface_of(map)) {}

MapSurfaces::MapSurfaces(const std::vector<matching::SurfacePoint>& points)
    : fine(of_points(points, fine_cell_m, fine_reach_m, fine_deviation_m)),
      coarse(of_points(points, coarse_cell_m, coarse_reach_m, coarse_deviation_m)),
      pyramid(coarse, levels) {}

Finding Finder::look(const Pose& odometry, std::span<const matching::SurfacePoint> scan) {
  if (!panorama_.add(odometry, scan)) return Finding::unchanged;
  const Pose moved = between(odometry_, odometry);
  odometry_ = odometry;
  std::optional<Pose> expected;
  if (candidate_) expected = compose(*candidate_, moved);
  candidate_.reset();
  if (panorama_.views() < parameters_.views_min) return Finding::too_little;

  const std::vector<matching::SurfacePoint> points = panorama_.points(spacing_m);
  const double cell_m = surfaces_.coarse.cell_m();
  matching::SearchWindow window;
  window.half_width_m = 0.5 * surfaces_.coarse.width() * cell_m;
  window.half_height_m = 0.5 * surfaces_.coarse.height() * cell_m;
  window.centre = {surfaces_.coarse.x() * cell_m + window.half_width_m,
                   surfaces_.coarse.y() * cell_m + window.half_height_m, 0};
  window.half_turn_rad = exact::pi;
  matching::SearchParameters search;
  search.score_min = parameters_.score_min;
  search.rival_share = parameters_.rival_share - rival_slack;
  search.peaks_max = peaks_max;
  search.arm_m = coarse_arm_m;
  search.apart_m = apart_m;
  search.apart_rad = apart_rad;
  search.openings_max = openings_max;
  search.spacing_m = 0;  // thinned already
  const std::vector<matching::Peak> peaks = matching::search(surfaces_.pyramid, points, window, search);
  // The coarse scores tell which places to compare; which of them is best, and by how much, the fine map tells.
  std::vector<matching::Refined> places;
  places.reserve(peaks.size());
  for (const matching::Peak& peak : peaks) places.push_back(refine(surfaces_.fine, points, peak.pose, {}, {}));
  const auto best = std::max_element(
      places.begin(), places.end(), [](const auto& one, const auto& other) { return one.explained < other.explained; });
  if (best == places.end() || best->explained < parameters_.explained_min) return Finding::nowhere;
  for (const matching::Refined& place : places)
    if (!are_one(place.pose, best->pose) && place.explained > parameters_.rival_share * best->explained)
      return Finding::ambiguous;
  candidate_ = best->pose;
  const bool confirmed = expected && are_one(best->pose, *expected);
  return confirmed ? Finding::found : Finding::candidate;
}

}  // namespace waitpoint::locate
