// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/executive.hpp"

#include <algorithm>

namespace waitpoint::executive {

using genom::PosterStatus;
using genom::Reply;
using posters::GoToInput;
using posters::NavigationReport;
using namespace std::chrono_literals;

Executive::Executive(genom::NameSpace& names, const Parameters& parameters, OccupancyGrid map,
                     const posters::KnownPose& start, std::vector<Point> goals)
    : names_(names),
      parameters_(parameters),
      client_(names, "executive"),
      planner_(std::move(map), parameters.planning),
      start_(start),
      goals_(std::move(goals)),
      reports_(goals_.size()) {}

void Executive::connect() {
  for (const char* module : {"rflex", "sick", "pom", "ndd"})
    if (names_.find_module(module) == nullptr)
      throw BadInput("the executive", std::string("needs the module '") + module + "'");
  for (genom::PosterLinkBase* link :
       {static_cast<genom::PosterLinkBase*>(&position_), static_cast<genom::PosterLinkBase*>(&echoes_)}) {
    genom::PosterBase* poster = names_.find_poster(link->name());
    if (poster == nullptr || !link->connect(*poster))
      throw BadInput("the executive", "reads poster '" + link->name() + "', which no module of this robot writes so");
  }
}

void Executive::run() {
  start_modules();
  wait_for_position();
  for (std::size_t i = 0; i < goals_.size(); ++i) reports_[i] = visit(goals_[i]);
  stop_modules();
}

void Executive::start_modules() {
  client_.call("rflex", "SetPos", start_);
  client_.call("pom", "SetPos", start_);
  client_.send("sick", "ContinuousShot");
  // A robot without SLAM goes by its odometry.
  if (names_.find_module("segloc") != nullptr) client_.send("segloc", "Localise", start_);
  client_.send("rflex", "TrackSpeedStart");
}

void Executive::wait_for_position() {
  posters::FusedPosition position;
  posters::Echoes echoes;
  while (position_.read(position) == PosterStatus::empty || echoes_.read(echoes) == PosterStatus::empty)
    threads::this_thread::sleep_for(50ms);
}

void Executive::stop_modules() {
  client_.call("ndd", "Stop");
  client_.call("rflex", "Stop");
  client_.call("sick", "Stop");
}

Point Executive::position() const {
  posters::FusedPosition position;
  position_.read(position);
  return position.position.pose.position();
}

GoalReport Executive::visit(Point goal) {
  const auto report = [](bool reached, const std::string& text) {
    return GoalReport{true, reached, threads::now(), text};
  };
  std::uint32_t tries = 0;
  for (;;) {
    planner_.plan(position(), goal, plan_);
    if (plan_.outcome != PlanOutcome::found) {
      if (!planner_.space().marked() || ++tries >= parameters_.tries_max)
        return report(false, to_string(plan_.outcome));
      planner_.space().forget();
      threads::this_thread::sleep_for(parameters_.pause_ms);
      continue;
    }
    const std::size_t points = std::min(plan_.via_points.size(), posters::via_point_count_max);
    const genom::Report ended = drive(points);
    if (ended == genom::ok) {
      if (points == plan_.via_points.size()) return report(true, "reached");
      continue;
    }
    if (++tries >= parameters_.tries_max) return report(false, "the way stays blocked");
    mark_obstacles();
  }
}

// Sends the first `points` via points of the plan and waits for the final report.
genom::Report Executive::drive(std::size_t points) {
  GoToInput input;
  for (std::size_t i = 0; i < points; ++i) input.via.push_back(plan_.via_points[i]);
  return client_.call("ndd", "GoTo", input).report;
}

// What the laser sees from where the robot stands, as obstacles on the map.
void Executive::mark_obstacles() {
  posters::FusedPosition position;
  posters::Echoes echoes;
  if (position_.read(position) == PosterStatus::empty || echoes_.read(echoes) == PosterStatus::empty) return;
  const Pose device = compose(position.position.pose, echoes.mount);
  std::vector<Point> points;
  for (std::size_t i = 0; i < echoes.scan.range_m.size(); ++i) {
    const double range = static_cast<double>(echoes.scan.range_m[i]);
    if (range >= parameters_.mark_range_m || range >= echoes.scan.range_max_m) continue;
    const auto [s, c] =
        exact::sincos(echoes.scan.first_angle_rad + echoes.scan.angle_step_rad * static_cast<double>(i));
    points.push_back(transform(device, {range * c, range * s}));
  }
  planner_.space().mark(points);
}

}  // namespace waitpoint::executive
