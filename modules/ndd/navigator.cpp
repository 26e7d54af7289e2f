// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace waitpoint::ndd {
namespace {

constexpr double standing_m_s = 0.05;
constexpr double about_turn_rad = 150 * exact::pi / 180;
constexpr double give_way_rad = 0.3, give_way_share = 0.4;
constexpr double security_m_min = 0.04;
constexpr int pushes_max = 4;
constexpr double push_m_max = 0.15;
constexpr double security_per_m = 0.5;  // growth of the security distance with distance from the target

struct WorkingMemory {
  std::vector<Point> obstacles;
  std::vector<Point> about_disc;  // the obstacles of the diagram, for a robot that is no disc
  Diagram diagram;
  Regions regions;
  std::vector<Foresight::Disc> moving;
};

WorkingMemory& working_memory() {
  thread_local const auto memory = std::make_unique<WorkingMemory>();
  return *memory;
}

// The displacement after `seconds` at constant speeds, in the robot's frame.
Pose displacement(const Speeds& speeds, double seconds) {
  const double turn = speeds.w_rad_s * seconds, way = speeds.v_m_s * seconds;
  const auto [s, c] = exact::sincos(0.5 * turn);
  return {way * c, way * s, turn};
}

Parameters with_radius(Parameters parameters, double radius_m) {
  parameters.robot_radius_m = radius_m;
  return parameters;
}

// Moves points towards the origin so that their distances from the footprint's greatest disc, in their directions, are
// those from its hull.
void draw_to_disc(const Footprint& footprint, std::span<const Point> points, std::vector<Point>& drawn) {
  drawn.clear();
  for (const Point p : points) {
    const double distance_m = std::sqrt(dot(p, p));
    if (distance_m == 0) continue;
    const double nearer_m = footprint.reach_m(p) - footprint.inner_radius_m();
    drawn.push_back((std::max(0.0, distance_m - nearer_m) / distance_m) * p);
  }
}

// Two crossing robots would push each other along, side by side. The robot that has the other one between itself and
// its target, on its right, gives way.
bool gives_way(const Assessment& assessment, Point target) {
  return assessment.safety < 1 && assessment.nearest_rad < 0 && target.y < 0 &&
         exact::atan2(target.y, target.x) < -give_way_rad;
}

}  // namespace

Navigator::Navigator(const Parameters& parameters)
    : footprint_({parameters.footprint.begin(), parameters.footprint.size()}, parameters.robot_radius_m),
      parameters_(with_radius(parameters, footprint_.inner_radius_m())),
      memory_(parameters),
      watch_(parameters.progress_m, Duration::from_seconds(parameters.patience_s)),
      bypass_(parameters_),
      limiter_(parameters_),
      shape_limiter_(parameters_, footprint_),
      foresight_(parameters_, footprint_) {}

void Navigator::add_odometry(const posters::Odometry& odometry) {
  trail_.add(odometry.position.date, odometry.position.pose);
  measured_ = {odometry.v_m_s, odometry.w_rad_s};
}

void Navigator::add_echoes(const posters::Echoes& echoes) {
  if (trail_.empty() || echoes.scan.date <= scan_date_) return;
  scan_date_ = echoes.scan.date;
  memory_.see(trail_.at(scan_date_), echoes);
  if (parameters_.foresight_s > 0) tracks_.see(compose(trail_.at(scan_date_), echoes.mount), echoes.scan);
}

Pose Navigator::in_map(const posters::PositionEstimate& position) const {
  return compose(position.pose, between(trail_.at(position.date), trail_.newest()));
}

void Navigator::go(Time now, const posters::PositionEstimate& position, std::span<const Point> via_points) {
  route_.start(position.pose.position(), via_points);
  watch_.start(now);
  last_target_.reset();
}

bool Navigator::reroute(const posters::PositionEstimate& position, std::span<const Point> via_points) {
  if (route_.empty()) return false;
  const Point start = position.pose.position();
  const double before_m = route_.remaining_m(start);
  route_.start(start, via_points);
  watch_.lengthen(route_.remaining_m(start) - before_m);
  return true;
}

Decision Navigator::decide(Time now, const posters::PositionEstimate& position) {
  if (route_.empty() || trail_.empty() || scan_date_ < Time()) return {};
  const Pose robot = in_map(position);
  const Pose ahead = displacement(measured_, parameters_.prediction_s);
  decided_for_ = compose(trail_.newest(), ahead);
  memory_.points_from(decided_for_, working_memory().obstacles);
  const auto seen_from_robot = [expected = compose(robot, ahead)](Point p) {
    return between(expected, {p.x, p.y, 0}).position();
  };
  route_.advance(robot.position(), parameters_.via_tolerance_m,
                 [&](Point next) { return is_clear(seen_from_robot(next)); });
  const Point via = seen_from_robot(route_.target());
  const Point target = clear_of_obstacles(via);
  Decision decision;
  decision.remaining_m = route_.remaining_m(robot.position());
  decision.outcome = outcome(now, decision.remaining_m, length(target));
  if (decision.outcome != RouteState::driving) route_.clear();
  if (decision.outcome == RouteState::driving && !at_goal(decision.remaining_m, length(target)))
    steer(now, target, decision);
  return decision;
}

bool Navigator::at_goal(double remaining_m, double target_distance_m) const {
  if (!route_.target_is_last()) return false;
  return remaining_m <= parameters_.goal_tolerance_m ||
         (remaining_m <= parameters_.goal_near_m && target_distance_m <= parameters_.goal_tolerance_m);
}

RouteState Navigator::outcome(Time now, double remaining_m, double target_distance_m) {
  if (at_goal(remaining_m, target_distance_m)) {
    return std::fabs(measured_.v_m_s) <= standing_m_s ? RouteState::arrived : RouteState::driving;
  }
  if (watch_.progressing(now, remaining_m)) return RouteState::driving;
  const bool near_enough = route_.target_is_last() && remaining_m <= parameters_.goal_near_m;
  return near_enough ? RouteState::arrived : RouteState::blocked;
}

void Navigator::steer(Time now, Point target, Decision& decision) {
  steer_among_standing(target, decision);
  if (parameters_.foresight_s > 0) decision.speeds = foresee(now, decision.speeds);
}

void Navigator::steer_among_standing(Point target, Decision& decision) {
  const double distance = length(target);
  const Assessment assessment = assess(target, distance);
  decision.situation = assessment.situation;
  decision.direction_rad = assessment.direction_rad;
  if (assessment.situation == Situation::no_region) return;
  double v_max = parameters_.v_m_s_max;
  if (gives_way(assessment, target)) v_max *= give_way_share;
  if (route_.target_is_last()) v_max = std::min(v_max, std::sqrt(2 * parameters_.goal_braking_m_s2 * distance));
  const Speeds wanted = motion_law(parameters_, assessment.direction_rad, assessment.safety, v_max);
  const std::vector<Point>& obstacles = working_memory().obstacles;
  decision.speeds = footprint_.is_disc() ? limiter_.limit(wanted, measured_, obstacles)
                                         : shape_limiter_.limit(wanted, measured_, obstacles);
}

// For the obstacles in motion as they will be when the command takes effect.
Speeds Navigator::foresee(Time now, const Speeds& wanted) {
  auto& [obstacles, about_disc, diagram, regions, moving] = working_memory();
  const Time effect = now + Duration::from_seconds(parameters_.prediction_s);
  moving.clear();
  for (const Track& track : tracks_.moving()) {
    const Point centre = track.at(effect);
    moving.push_back({between(decided_for_, {centre.x, centre.y, 0}).position(),
                      transform({0, 0, -decided_for_.heading}, track.velocity), track.radius_m});
  }
  return foresight_.choose(wanted, measured_, moving, obstacles);
}

// True if the robot's disc touches no known obstacle on the straight way to a target.
bool Navigator::is_clear(Point target) const {
  const double least = parameters_.robot_radius_m + parameters_.emergency_distance_m;
  const double square = dot(target, target);
  return std::none_of(working_memory().obstacles.begin(), working_memory().obstacles.end(), [&](Point p) {
    const double part = square == 0 ? 0 : std::clamp(dot(p, target) / square, 0.0, 1.0);
    const Point aside = p - part * target;
    return dot(aside, aside) < least * least;
  });
}

// A small position error can put a via point into a door's jamb, or the goal into a wall: the robot drives to the
// nearest position where it fits. If that is far, the point itself is kept.
Point Navigator::clear_of_obstacles(Point via) const {
  const double least = parameters_.robot_radius_m + parameters_.emergency_distance_m;
  Point target = via;
  for (int push = 0; push < pushes_max; ++push) {
    double nearest = least;
    Point away;
    for (const Point p : working_memory().obstacles) {
      const Point d = target - p;
      if (dot(d, d) >= nearest * nearest) continue;
      nearest = length(d);
      away = d;
    }
    if (nearest >= least || nearest == 0) break;
    target = target + ((least - nearest) / nearest) * away;
  }
  return length(target - via) <= push_m_max ? target : via;
}

Assessment Navigator::assess(Point target, double target_distance_m) {
  auto& [obstacles, about_disc, diagram, regions, moving] = working_memory();
  if (!footprint_.is_disc()) draw_to_disc(footprint_, obstacles, about_disc);
  diagram.build(footprint_.is_disc() ? obstacles : about_disc, parameters_.diagram_range_m);
  const double width = 2 * parameters_.robot_radius_m;
  find_regions(diagram, width, regions);
  std::optional<Point> previous;
  if (last_target_) previous = between(decided_for_, {last_target_->x, last_target_->y, 0}).position();
  const Choice choice = choose_region(diagram, regions, target, previous, width);
  if (choice.found) last_target_ = transform(decided_for_, choice.target);
  const double security = security_distance_m(target, target_distance_m);
  Assessment free_way = high_safety(diagram, choice, parameters_.robot_radius_m, security);
  if (free_way.situation == Situation::no_region) return free_way;
  const double regarded = std::min(parameters_.bypass_distance_m, length(choice.target));
  free_way.direction_rad = keep_turning(bypass_.clear(diagram, free_way.direction_rad, regarded));
  return with_obstacles(diagram, free_way, parameters_.robot_radius_m, security);
}

// With its full security distance, a wall close to the target would deflect the motion from it.
double Navigator::security_distance_m(Point target, double target_distance_m) const {
  double nearest = parameters_.robot_radius_m + parameters_.security_distance_m;
  for (const Point p : working_memory().obstacles) {
    const Point d = p - target;
    if (dot(d, d) < nearest * nearest) nearest = std::sqrt(dot(d, d));
  }
  const double at_target = std::max(security_m_min, nearest - parameters_.robot_radius_m);
  return std::min(parameters_.security_distance_m, at_target + security_per_m * target_distance_m);
}

// With the target straight behind, noise would change the turning direction with every scan.
double Navigator::keep_turning(double direction_rad) {
  if (std::fabs(direction_rad) > about_turn_rad && direction_rad * last_turn_ < 0) {
    direction_rad += direction_rad > 0 ? -2 * exact::pi : 2 * exact::pi;
  }
  last_turn_ = direction_rad;
  return direction_rad;
}

void Navigator::echoes_in_map(const posters::PositionEstimate& position, std::vector<Point>& points) const {
  points.clear();
  if (trail_.empty()) return;
  const Pose odometry_in_map = compose(in_map(position), between(trail_.newest(), Pose{}));
  for (const Point p : memory_.newest()) points.push_back(transform(odometry_in_map, p));
}

}  // namespace waitpoint::ndd
