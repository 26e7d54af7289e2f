// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/news_reader.hpp"

#include <utility>

#include "modules/run/plan.hpp"

namespace waitpoint::tools {
namespace {

constexpr Duration sampling = std::chrono::milliseconds(100);

std::vector<world::Shape> shapes_of(const std::vector<world::Obstacle>& obstacles) {
  std::vector<world::Shape> shapes;
  shapes.reserve(obstacles.size());
  for (const world::Obstacle& obstacle : obstacles) shapes.push_back(obstacle.shape);
  return shapes;
}

}  // namespace

NewsReader::NewsReader(const scenario::Scenario& scenario, run::Experiment& experiment, Obstacles obstacles)
    : experiment_(experiment), obstacles_(obstacles) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    if (!experiment.is_here(i)) continue;
    bridge::Robot& robot = *experiment.robots()[i];
    robots_.push_back(
        {static_cast<std::uint32_t>(i), RobotPosters(scenario.robots[i], robot), ModuleLog(robot.watch())});
    robot.set_watch(&robots_.back().modules);
  }
}

// The first step, and each that is a tenth of a second or more after the last sample.
bool NewsReader::is_sample(Time now) {
  if (last_sample_ && now - *last_sample_ < sampling) return false;
  last_sample_ = now;
  return true;
}

StepNews NewsReader::take(Time now) {
  StepNews news{.now = now, .is_sampled = is_sample(now)};
  if (news.is_sampled && obstacles_ == Obstacles::read && has_new_obstacles()) news.obstacles = drawn_;
  news.robots.reserve(robots_.size());
  for (OfRobot& robot : robots_) {
    const world::BodyState& body = experiment_.world().body(world::BodyId(robot.number));
    RobotNews& of_robot = news.robots.emplace_back(RobotNews{robot.number, body.pose, body.height_m});
    of_robot.lines = robot.modules.take();
    of_robot.odometry = robot.posters.odometry();
    if (const auto fused = robot.posters.position()) of_robot.position = fused->position;
    of_robot.readings = robot.posters.readings();
  }
  return news;
}

bool NewsReader::has_new_obstacles() {
  const world::WorldDescription& world = experiment_.world().description();
  if (!meshes_) meshes_ = shapes_of(run::meshes_on_plan(world));
  std::vector<world::Shape> shapes = shapes_of(world.obstacles);
  shapes.insert(shapes.end(), meshes_->begin(), meshes_->end());
  if (drawn_ == shapes) return false;
  drawn_ = std::move(shapes);
  return true;
}

std::vector<RobotLines> NewsReader::lines() {
  std::vector<RobotLines> all;
  for (OfRobot& robot : robots_) all.push_back({robot.number, robot.modules.take()});
  return all;
}

}  // namespace waitpoint::tools
