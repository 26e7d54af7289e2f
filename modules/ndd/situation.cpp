// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/situation.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::ndd {
namespace {

constexpr double right_angle = exact::pi / 2;
constexpr double wide_rad = right_angle;
constexpr double regarded_rad = 110 * exact::pi / 180;

struct Threat {
  double closeness = 1;  // hull distance in security distances; 1: none
  double angle_rad = 0;
  bool present() const { return closeness < 1; }
};

double clamp_to_front(double angle_rad) { return std::clamp(angle_rad, -right_angle, right_angle); }

}  // namespace

const char* to_string(Situation situation) {
  switch (situation) {
    case Situation::no_region: return "none";
    case Situation::high_safety_goal_region: return "HSGR";
    case Situation::high_safety_wide_region: return "HSWR";
    case Situation::high_safety_narrow_region: return "HSNR";
    case Situation::low_safety_goal_region: return "LSGR";
    case Situation::low_safety_one_side: return "LS1";
    case Situation::low_safety_two_sides: return "LS2";
  }
  return "?";
}

Assessment high_safety(const Diagram& diagram, const Choice& choice, double robot_radius_m,
                       double security_distance_m) {
  if (!choice.found) return {};
  if (choice.goal_reachable) {
    return {Situation::high_safety_goal_region, exact::atan2(choice.target.y, choice.target.x), 1, 0};
  }
  const Region& region = choice.region;
  const Sector& edge = diagram[choice.at_right_edge ? region.first - 1 : region.last() + 1];
  if (region.width_rad() <= wide_rad || !edge.occupied()) {
    return {Situation::high_safety_narrow_region, region.middle_rad(), 1, 0};
  }
  const double aside = exact::atan2(robot_radius_m + security_distance_m, edge.distance_m);
  const double direction = choice.at_right_edge ? edge.angle_rad + aside : edge.angle_rad - aside;
  return {Situation::high_safety_wide_region, exact::wrap_angle(direction), 1, 0};
}

Assessment with_obstacles(const Diagram& diagram, const Assessment& free_way, double robot_radius_m,
                          double security_distance_m) {
  if (free_way.situation == Situation::no_region) return free_way;
  Threat left, right;
  for (int i = 0; i < sector_count; ++i) {
    const Sector& sector = diagram[i];
    if (!sector.occupied() || std::fabs(sector.angle_rad) > regarded_rad) continue;
    const double closeness = std::max(0.0, sector.distance_m - robot_radius_m) / security_distance_m;
    Threat& side = exact::wrap_angle(sector.angle_rad - free_way.direction_rad) >= 0 ? left : right;
    if (closeness < side.closeness) side = {closeness, sector.angle_rad};
  }
  const double ahead = free_way.direction_rad;
  Assessment result = {free_way.situation, ahead, std::min(left.closeness, right.closeness),
                       left.closeness < right.closeness ? left.angle_rad : right.angle_rad};
  if (left.present() && right.present()) {
    // With equal closeness the direction is kept; an obstacle touching one side turns it perpendicular to that side.
    const double k = (left.closeness - right.closeness) / std::max(left.closeness + right.closeness, 1e-9);
    result.situation = Situation::low_safety_two_sides;
    const double front = clamp_to_front(ahead);
    result.direction_rad = k <= 0 ? front + k * (front + right_angle) : front + k * (right_angle - front);
  } else if (left.present() || right.present()) {
    const Threat& threat = left.present() ? left : right;
    // The direction opposite to the obstacle, on its far side: an obstacle on the left is left of `ahead` by 0 to pi.
    const double offset = exact::wrap_angle(threat.angle_rad - ahead);
    const double away = left.present() ? offset - exact::pi : offset + exact::pi;
    result.situation = free_way.situation == Situation::high_safety_goal_region ? Situation::low_safety_goal_region
                                                                                : Situation::low_safety_one_side;
    result.direction_rad = ahead + (1 - threat.closeness) * away;
  }
  result.direction_rad = clamp_to_front(result.direction_rad);
  return result;
}

}  // namespace waitpoint::ndd
