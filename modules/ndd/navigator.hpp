// SPDX-License-Identifier: BSD-3-Clause
// Reactive navigation along via points: from odometry, scans and the fused position to a speed command.
//
//   scan, odometry -> ObstacleMemory -> Diagram -> Regions -> Choice -> Situation -> motion law -> SpeedLimiter
//   via points, position -> Route ---------------------------^
//
// Obstacles are in the odometry frame, via points in the map frame. A decision is made for the predicted pose at which
// the command takes effect. The robot turns on the spot towards a goal behind it; it drives backwards only to back out.
//
// A robot that is no disc is, to the diagram, the greatest disc that its footprint holds, among obstacles that are
// nearer by what the hull reaches beyond that disc in their directions; its speeds are limited by its own shape.
//
// The working memory of a decision, up to 40 KB, is one per thread of the system: all robots' decisions pass through
// it, one after the other, and it stays in the cache.
#pragma once

#include "modules/ndd/bypass.hpp"
#include "modules/ndd/foresight.hpp"
#include "modules/ndd/motion_law.hpp"
#include "modules/ndd/obstacle_memory.hpp"
#include "modules/ndd/obstacle_tracks.hpp"
#include "modules/ndd/progress_watch.hpp"
#include "modules/ndd/route.hpp"
#include "modules/ndd/shape_limiter.hpp"
#include "modules/ndd/situation.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::ndd {

enum class RouteState : std::uint8_t {
  idle,     ///< no route
  driving,  ///< following the route
  arrived,  ///< at rest within the tolerance of the last via point, or as close as possible
  blocked,  ///< no progress within the patience: the robot is at rest, the route abandoned
};

struct Decision {
  RouteState outcome = RouteState::idle;
  Situation situation = Situation::no_region;
  Speeds speeds;             ///< command until the next decision
  double direction_rad = 0;  ///< desired direction, in the robot's frame
  double remaining_m = 0;    ///< length of the remaining route
};

class Navigator {
 public:
  explicit Navigator(const Parameters& parameters);

  void add_odometry(const posters::Odometry& odometry);
  /// Adds a scan; ignored if its date is already known, or before any odometry.
  void add_echoes(const posters::Echoes& echoes);

  /// Starts a route of via points in the map frame.
  void go(Time now, const posters::PositionEstimate& position, std::span<const Point> via_points);
  /// Replaces the present route by another one to the same goal, in motion. False without a route.
  bool reroute(const posters::PositionEstimate& position, std::span<const Point> via_points);
  void stop() { route_.clear(); }
  const Route& route() const { return route_; }

  /// The command for the next control period. `position` is in the map frame, of any date within the odometry trail.
  /// After `arrived` or `blocked` the route has ended and the next decision is `idle`.
  Decision decide(Time now, const posters::PositionEstimate& position);

  /// The obstacle points of the newest scan in the map frame, for replanning.
  void echoes_in_map(const posters::PositionEstimate& position, std::vector<Point>& points) const;
  const Parameters& parameters() const { return parameters_; }

 private:
  Pose in_map(const posters::PositionEstimate& position) const;
  bool at_goal(double remaining_m, double target_distance_m) const;
  RouteState outcome(Time now, double remaining_m, double target_distance_m);
  void steer(Time now, Point target, Decision& decision);
  void steer_among_standing(Point target, Decision& decision);
  Speeds foresee(Time now, const Speeds& wanted);
  bool is_clear(Point target) const;
  Point clear_of_obstacles(Point via) const;
  Assessment assess(Point target, double target_distance_m);
  double security_distance_m(Point target, double target_distance_m) const;
  double keep_turning(double direction_rad);

  Footprint footprint_;
  Parameters parameters_;  // with the radius of the greatest disc that the footprint holds
  posters::OdometryTrail trail_;
  Speeds measured_;
  ObstacleMemory memory_;
  ObstacleTracks tracks_;
  Time scan_date_ = Time::from_ns(-1);
  Route route_;
  ProgressWatch watch_;
  Bypass bypass_;
  SpeedLimiter limiter_;
  ShapeLimiter shape_limiter_;
  Foresight foresight_;
  std::optional<Point> last_target_;  // of the region choice, in the odometry frame
  double last_turn_ = 0;              // direction of the last decision

  Pose decided_for_;  // in the odometry frame
};

}  // namespace waitpoint::ndd
