// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/frame_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "modules/genom/module.hpp"
#include "tools/view/request.hpp"
#include "tools/view/scene.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {
namespace {

const posters::FollowedRoute* follower_of_routes(const genom::NameSpace& names) {
  for (const auto& [name, module] : names.modules())
    if (const auto* follower = dynamic_cast<const posters::FollowedRoute*>(module); follower != nullptr)
      return follower;
  return nullptr;
}

void append_pose(std::string& text, const Pose& pose) {
  const double values[] = {pose.x, pose.y, pose.heading};
  append_numbers(text, values);
}

}  // namespace

FrameOptions frame_options(const Json& request, std::size_t robots) {
  FrameOptions options;
  options.scans = flag_in(request, "scans", true);
  options.whole = flag_in(request, "whole", false);
  const std::int64_t last = static_cast<std::int64_t>(robots) - 1;
  if (const std::int64_t robot = whole_number_in(request, "robot", -1, last, -1); robot >= 0)
    options.robot = static_cast<std::size_t>(robot);
  const Json view = request.value("view", Json());
  if (view.is_null()) return options;
  if (!view.is_array() || view.size() != 4 ||
      !std::all_of(view.begin(), view.end(), [](const Json& side) { return side.is_number(); }))
    throw BadInput("the view", "'view': expected [left, bottom, right, top] in metres");
  options.section = Section{{view[0], view[1]}, {view[2], view[3]}};
  return options;
}

FrameReader::FrameReader(const scenario::Scenario& scenario, const run::Experiment& experiment)
    : scenario_(scenario), experiment_(experiment) {
  for (const world::Obstacle& obstacle : experiment.world().description().obstacles)
    at_start_.push_back(obstacle.shape);
  drawn_ = at_start_;
  take_up_robots();
}

void FrameReader::take_up_robots() {
  robots_.clear();
  for (std::size_t i = 0; i < scenario_.robots.size(); ++i) {
    const bridge::Robot& robot = *experiment_.robots()[i];
    const genom::NameSpace& names = robot.names();
    robots_.push_back(OfRobot{robot,
                              world::BodyId(i),
                              recorded_sensors<world::Lasers>(scenario_.robots[i]),
                              {scenario_.robots[i], robot},
                              {names, "rflex.sonars"},
                              {names, "segloc.map"},
                              follower_of_routes(names)});
  }
}

std::string FrameReader::read(Time now, const FrameOptions& options) {
  if (options.whole) {
    take_up_robots();
    drawn_ = at_start_;
  }
  has_news_ = options.whole;
  std::string text = fmt::format("{{\"kind\":\"frame\",\"line\":{},\"time\":{},\"events\":{},\"whole\":{},\"robots\":[",
                                 options.line, now.ns(), experiment_.events(), options.whole);
  for (OfRobot& robot : robots_) {
    if (&robot != &robots_.front()) text += ',';
    add(robot, options, text);
  }
  text += ']';
  add_obstacles(text);
  return text + (has_news_ ? ",\"news\":true" : ",\"news\":false");
}

void FrameReader::add(OfRobot& robot, const FrameOptions& options, std::string& text) {
  const world::BodyState& body = experiment_.world().body(robot.body);
  const bool is_chosen = options.robot && *options.robot == static_cast<std::size_t>(robot.body);
  if (options.section && !is_chosen && !options.section->holds(body.pose.position())) {
    text += "null";
    return;
  }
  const double truth[] = {body.pose.x, body.pose.y, body.pose.heading, body.height_m};
  text += "{\"truth\":";
  append_numbers(text, truth);
  if (!options.robot || is_chosen) {
    add_poses(robot, text);
    if (options.scans) add_scans(robot, text);
    add_news(robot, text);
  }
  const auto goal = robot.robot.current_goal();
  text += fmt::format(",\"goal\":{},\"goals_reached\":{},\"collisions\":{}}}",
                      goal ? static_cast<std::int64_t>(*goal) : -1, robot.robot.goals_reached(), body.collisions);
}

void FrameReader::add_poses(OfRobot& robot, std::string& text) {
  if (const auto odometry = robot.posters.odometry()) robot.odometry = odometry->position.pose;
  if (const auto fused = robot.posters.position()) robot.position = fused->position;
  if (robot.position) {
    const std::array<double, 9>& c = robot.position->covariance;
    const double of_position[] = {c[0], c[1], c[4]};
    text += ",\"estimate\":";
    append_pose(text, robot.position->pose);
    // To more digits than lengths: they are squares.
    text += fmt::format(",\"covariance\":[{:.3g},{:.3g},{:.3g}]", of_position[0], of_position[1], of_position[2]);
  }
  if (robot.odometry) {
    text += ",\"odometry\":";
    append_pose(text, *robot.odometry);
  }
}

void FrameReader::add_scans(OfRobot& robot, std::string& text) {
  const NewReadingsOf<world::Lasers> scans = robot.posters.readings_of<world::Lasers>();
  bool any = false;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!scans[i]) continue;
    text += any ? "," : ",\"scans\":[";
    any = true;
    text += fmt::format("{{\"laser\":{},\"first\":{:.6f},\"step\":{:.8f},\"max\":{},\"ranges\":[", i,
                        scans[i]->first_angle_rad, scans[i]->angle_step_rad, scans[i]->range_max_m);
    for (std::size_t beam = 0; beam < scans[i]->range_m.size(); ++beam) {
      if (beam > 0) text += ',';
      append_number(text, static_cast<double>(scans[i]->range_m[beam]));
    }
    text += "]}";
  }
  if (any) text += ']';
  const auto sonars = robot.sonars.take([](const posters::Sonars& sonars) { return sonars.date; });
  if (!sonars) return;
  text += ",\"sonars\":[";
  for (const posters::SonarEcho& echo : sonars->echoes) {
    if (&echo != sonars->echoes.begin()) text += ',';
    append_number(text, echo.range_m);
  }
  text += ']';
}

void FrameReader::add_news(OfRobot& robot, std::string& text) {
  if (robot.module != nullptr) {
    const std::span<const Point> ahead = robot.module->route_ahead();
    if (!robot.route || !std::equal(ahead.begin(), ahead.end(), robot.route->begin(), robot.route->end())) {
      has_news_ = true;
      robot.route.emplace(ahead.begin(), ahead.end());
      text += ",\"route\":[";
      for (const Point& p : ahead) {
        const double values[] = {p.x, p.y};
        if (&p != ahead.data()) text += ',';
        append_numbers(text, values);
      }
      text += ']';
    }
  }
  const auto map = robot.segments.take([](const posters::SegmentMap& segments) { return segments.date; });
  if (!map) return;
  has_news_ = true;
  text += ",\"segments\":[";
  for (const posters::MapSegment& segment : map->items) {
    const double values[] = {segment.start.x, segment.start.y, segment.end.x, segment.end.y};
    if (&segment != map->items.begin()) text += ',';
    append_numbers(text, values);
  }
  text += ']';
}

// They are many, and seldom change.
bool FrameReader::shows_as_drawn() const {
  const std::vector<world::Obstacle>& obstacles = experiment_.world().description().obstacles;
  return std::equal(obstacles.begin(), obstacles.end(), drawn_.begin(), drawn_.end(),
                    [](const world::Obstacle& obstacle, const world::Shape& drawn) { return obstacle.shape == drawn; });
}

void FrameReader::add_obstacles(std::string& text) {
  if (shows_as_drawn()) return;
  has_news_ = true;
  drawn_.clear();
  for (const world::Obstacle& obstacle : experiment_.world().description().obstacles) drawn_.push_back(obstacle.shape);
  Json list = Json::array();
  for (const world::Obstacle& shown : obstacles_shown(experiment_)) list.push_back(obstacle(shown));
  text += ",\"obstacles\":" + text_of(list);
}

}  // namespace waitpoint::tools::view
