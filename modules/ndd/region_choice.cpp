// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/region_choice.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace waitpoint::ndd {
namespace {

constexpr int left_handicap_sectors = 5;
constexpr int kept_bonus_sectors = 10;
constexpr double kept_distance_m = 0.6;
constexpr double behind_edge_m_max = 1.0;  // a sub-goal farther behind the edge is not more informative

struct Opening {
  Region region;
  bool at_right_edge;
  Point sub_goal;
  int detour_sectors;  // from the goal's direction, with penalty and bonus
};

using Openings = Bounded<Opening, std::size_t{2} * sector_count>;

void favour_nearest(Openings& openings, Point previous) {
  Opening* nearest = nullptr;
  double least = kept_distance_m;
  for (Opening& opening : openings) {
    const double distance = length(opening.sub_goal - previous);
    if (distance >= least) continue;
    least = distance;
    nearest = &opening;
  }
  if (nearest != nullptr) nearest->detour_sectors -= kept_bonus_sectors;
}

// The midpoint of the gap, on the ray next to the edge.
Point sub_goal_of(const Diagram& diagram, const Region& region, bool at_right_edge, double robot_width_m) {
  const int inner = at_right_edge ? region.first : region.last();
  const Sector& edge = diagram[at_right_edge ? inner - 1 : inner + 1];
  const Sector& far = diagram[inner];
  if (!edge.occupied()) {  // the diagram is empty
    const auto [s, c] = exact::sincos(region.middle_rad());
    return {c, s};
  }
  const double behind = far.occupied() ? 0.5 * (far.distance_m - edge.distance_m) : robot_width_m;
  const double distance = edge.distance_m + std::min(behind, behind_edge_m_max);
  const auto [s, c] = exact::sincos(Diagram::bisector_rad(inner));
  return {distance * c, distance * s};
}

int detour_of(int goal_sector, int edge_sector) {
  const int turn = static_cast<int>(Diagram::wrap(edge_sector - goal_sector));
  return turn < sector_count / 2 ? turn + left_handicap_sectors : sector_count - turn;
}

Region region_with(const Regions& regions, int sector) {
  for (const Region& region : regions) {
    if (region.holds(sector)) return region;
  }
  return {sector, 1, false, false};
}

}  // namespace

bool reachable(const Diagram& diagram, Point target, double robot_width_m) {
  const double distance = length(target);
  if (distance == 0) return true;
  const Point along = (1 / distance) * target;
  const double radius = 0.5 * robot_width_m;
  Bounded<Point, sector_count> left, right;
  for (int i = 0; i < sector_count; ++i) {
    if (!diagram[i].occupied()) continue;
    const Point p = diagram[i].nearest;
    const Point rest = p - target;
    if (dot(rest, rest) < radius * radius) return false;
    const double ahead = dot(along, p), aside = cross(along, p);
    if (ahead < 0 || ahead > distance || std::fabs(aside) > robot_width_m) continue;
    (aside >= 0 ? left : right).push_back(p);
  }
  for (const Point l : left) {
    for (const Point r : right) {
      const Point across = l - r;
      if (dot(across, across) < robot_width_m * robot_width_m) return false;
    }
  }
  return true;
}

Choice choose_region(const Diagram& diagram, const Regions& regions, Point goal, std::optional<Point> previous,
                     double robot_width_m) {
  const int goal_sector = Diagram::sector_at(exact::atan2(goal.y, goal.x));
  const double goal_distance = length(goal);
  if (diagram[goal_sector].distance_m > goal_distance && reachable(diagram, goal, robot_width_m)) {
    return {true, true, region_with(regions, goal_sector), false, goal};
  }
  Openings openings;
  const auto add = [&](const Region& region, bool at_right_edge) {
    openings.push_back({region, at_right_edge, sub_goal_of(diagram, region, at_right_edge, robot_width_m),
                        detour_of(goal_sector, at_right_edge ? region.first : region.last())});
  };
  for (const Region& region : regions) {
    if (region.opens_at_right) add(region, true);
    if (region.opens_at_left) add(region, false);
  }
  if (previous) favour_nearest(openings, *previous);
  std::sort(openings.begin(), openings.end(), [](const Opening& a, const Opening& b) {
    return std::tuple(a.detour_sectors, a.region.first, !a.at_right_edge) <
           std::tuple(b.detour_sectors, b.region.first, !b.at_right_edge);
  });
  for (const Opening& opening : openings) {
    if (reachable(diagram, opening.sub_goal, robot_width_m)) {
      return {true, false, opening.region, opening.at_right_edge, opening.sub_goal};
    }
  }
  return {};
}

}  // namespace waitpoint::ndd
