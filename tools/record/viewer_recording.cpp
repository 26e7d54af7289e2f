// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/viewer_recording.hpp"

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

void ViewerRecording::begin(run::Experiment& experiment) {
  for (std::size_t i = 0; i < scenario_.robots.size(); ++i) {
    bridge::Robot& robot = *experiment.robots()[i];
    robots_.push_back({i, robot.name(), RobotPosters(scenario_.robots[i], robot), std::make_unique<ModuleLog>()});
    add(robots_.back());
    robot.set_watch(robots_.back().modules.get());
  }
}

void ViewerRecording::record(const run::Experiment& experiment, Time now) {
  set_time(now);
  const bool is_sampled = !sampled_ || now - *sampled_ >= sampling;
  if (is_sampled) {
    sampled_ = now;
    write_clock();
    if (!meshes_) meshes_ = shapes_of(run::meshes_on_plan(experiment.world().description()));
    record_obstacles(experiment.world().description().obstacles);
  }
  for (OfRobot& robot : robots_) {
    if (is_sampled) record_truth(robot, experiment.world(), now);
    record_news(robot);
  }
}

void ViewerRecording::record_obstacles(const std::vector<world::Obstacle>& obstacles) {
  std::vector<world::Shape> shapes = shapes_of(obstacles);
  shapes.insert(shapes.end(), meshes_->begin(), meshes_->end());
  if (drawn_ == shapes) return;
  write_obstacles(shapes);
  drawn_ = std::move(shapes);
}

void ViewerRecording::record_truth(const OfRobot& robot, const world::World& world, Time now) {
  const world::BodyState& body = world.body(world::BodyId(static_cast<std::uint32_t>(robot.number)));
  write_transform(now, root, robot.name, body.pose, body.height_m);
  write_truth(robot, now, body);
}

void ViewerRecording::record_news(OfRobot& robot) {
  record_modules(robot);
  const std::string believed = robot.name + "/position";
  if (const auto odometry = robot.posters.odometry()) write_odometry(robot, *odometry);
  if (const auto fused = robot.posters.position()) {
    write_position(robot, fused->position);
    write_transform(fused->position.date, root, believed, fused->position.pose, 0);
  }
  for (std::size_t k = 0; k < robot.posters.lasers.size(); ++k) {
    RobotPosters::Laser& laser = robot.posters.lasers[k];
    const auto scan = robot.posters.scan(laser);
    if (!scan) continue;
    const std::string frame = robot.name + "/" + laser.name;
    write_transform(scan->date, believed, frame, laser.description.mount, laser.description.height_m);
    write_scan(robot, k, frame, *scan);
  }
}

void ViewerRecording::record_modules(OfRobot& robot) {
  for (const ModuleLog::Line& line : robot.modules->take()) write_log(robot, line);
}

void ViewerRecording::commit(const bridge::RunResult& result) {
  set_time(Time() + result.simulated);
  for (OfRobot& robot : robots_) record_modules(robot);
  close(result);
}

}  // namespace waitpoint::tools
