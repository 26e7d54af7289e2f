// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/frame_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "modules/genom/module.hpp"
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

std::vector<world::Shape> shapes_of(const std::vector<world::Obstacle>& obstacles) {
  std::vector<world::Shape> shapes;
  shapes.reserve(obstacles.size());
  for (const world::Obstacle& obstacle : obstacles) shapes.push_back(obstacle.shape);
  return shapes;
}

void append_pose(std::string& text, const Pose& pose) {
  const double values[] = {pose.x, pose.y, pose.heading};
  append_numbers(text, values);
}

}  // namespace

FrameReader::FrameReader(const scenario::Scenario& scenario, const run::Experiment& experiment)
    : experiment_(experiment), drawn_(shapes_of(experiment.world().description().obstacles)) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const bridge::Robot& robot = *experiment.robots()[i];
    const genom::NameSpace& names = robot.names();
    robots_.push_back(OfRobot{robot,
                              world::BodyId(i),
                              recorded_lasers(scenario.robots[i]),
                              {scenario.robots[i], robot},
                              {names, "rflex.sonars"},
                              {names, "segloc.map"},
                              follower_of_routes(names)});
  }
}

std::string FrameReader::read(Time now, const FrameOptions& options) {
  std::string text = fmt::format("{{\"kind\":\"frame\",\"line\":{},\"time\":{},\"events\":{},\"robots\":[",
                                 options.line, now.ns(), experiment_.events());
  for (OfRobot& robot : robots_) {
    if (&robot != &robots_.front()) text += ',';
    add(robot, options, text);
  }
  text += ']';
  add_obstacles(text);
  return text;
}

void FrameReader::add(OfRobot& robot, const FrameOptions& options, std::string& text) {
  const world::BodyState& body = experiment_.world().body(robot.body);
  if (options.section && !options.section->holds(body.pose.position())) {
    text += "null";
    return;
  }
  const double truth[] = {body.pose.x, body.pose.y, body.pose.heading, body.height_m};
  text += "{\"truth\":";
  append_numbers(text, truth);
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
  if (options.scans) add_scans(robot, text);
  add_news(robot, text);
  const auto goal = robot.robot.current_goal();
  text += fmt::format(",\"goal\":{},\"goals_reached\":{},\"collisions\":{}}}",
                      goal ? static_cast<std::int64_t>(*goal) : -1, robot.robot.goals_reached(), body.collisions);
}

void FrameReader::add_scans(OfRobot& robot, std::string& text) {
  const std::vector<std::optional<posters::LaserReading>> scans = robot.posters.scans();
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
  text += ",\"segments\":[";
  for (const posters::MapSegment& segment : map->items) {
    const double values[] = {segment.start.x, segment.start.y, segment.end.x, segment.end.y};
    if (&segment != map->items.begin()) text += ',';
    append_numbers(text, values);
  }
  text += ']';
}

void FrameReader::add_obstacles(std::string& text) {
  std::vector<world::Shape> shapes = shapes_of(experiment_.world().description().obstacles);
  if (shapes == drawn_) return;
  drawn_ = std::move(shapes);
  Json list = Json::array();
  for (const world::Obstacle& shown : obstacles_shown(experiment_)) list.push_back(obstacle(shown));
  text += ",\"obstacles\":" + text_of(list);
}

}  // namespace waitpoint::tools::view
