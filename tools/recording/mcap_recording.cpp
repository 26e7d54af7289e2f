// SPDX-License-Identifier: BSD-3-Clause
#include "tools/recording/mcap_recording.hpp"

#include <fmt/format.h>

#include "tools/recording/foxglove.hpp"

namespace waitpoint::tools {
namespace {

constexpr Duration sampling = std::chrono::milliseconds(100);
constexpr const char* root = "world";

std::uint16_t add(McapFile& file, const foxglove::Schema& schema) { return file.add_schema(schema.name, schema.text); }

std::string clock_text(Time now) {
  constexpr std::int64_t second = 1'000'000'000;
  return fmt::format(R"({{"clock":{{"sec":{},"nsec":{}}}}})", now.ns() / second, now.ns() % second);
}

}  // namespace

McapRecording::McapRecording(const std::filesystem::path& path, const bridge::Scenario& scenario)
    : scenario_(scenario),
      file_(path),
      transform_(add(file_, foxglove::frame_transform())),
      scan_(add(file_, foxglove::laser_scan())),
      log_(add(file_, foxglove::log())),
      pose_(add(file_, foxglove::pose_in_frame())),
      scene_(add(file_, foxglove::scene_update())),
      time_(file_.add_schema("waitpoint.Clock",
                             R"({"title":"waitpoint.Clock","type":"object","properties":{"clock":{"type":"object",)"
                             R"("properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}}}})")),
      frames_(file_.add_channel(transform_, "/tf")),
      world_(file_.add_channel(scene_, "/world")),
      clock_(file_.add_channel(time_, "/clock")) {}

void McapRecording::begin(bridge::Experiment& experiment) {
  for (std::size_t i = 0; i < scenario_.robots.size(); ++i) {
    const std::string& name = scenario_.robots[i].name;
    const auto channel = [&](std::uint16_t schema, const std::string& topic) {
      return file_.add_channel(schema, "/" + name + "/" + topic);
    };
    RobotPosters posters(scenario_.robots[i], *experiment.robots()[i]);
    std::vector<std::uint16_t> scans;
    for (const RobotPosters::Laser& laser : posters.lasers) scans.push_back(channel(scan_, laser.name));
    const std::uint16_t odometry = channel(pose_, "odometry"), position = channel(pose_, "position");
    const std::uint16_t truth = channel(pose_, "truth");
    robots_.push_back({std::move(posters), std::make_unique<ModuleLog>(), std::move(scans), odometry, position, truth,
                       channel(log_, "modules")});
    experiment.robots()[i]->set_watch(robots_.back().modules.get());
  }
}

void McapRecording::record(const bridge::Experiment& experiment, Time now) {
  const world::World& world = experiment.world();
  const bool is_sampled = !sampled_ || now - *sampled_ >= sampling;
  if (is_sampled) {
    file_.write(clock_, now, clock_text(now));
    // Its time is that of the first message, whenever that was: the same world is the same text.
    std::string drawn = foxglove::scene_update(Time(), root, world.description().obstacles);
    if (drawn != drawn_) file_.write(world_, now, drawn_ = std::move(drawn));
    sampled_ = now;
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::string& name = scenario_.robots[i].name;
    const world::BodyState& body = world.body(world::BodyId(static_cast<std::uint32_t>(i)));
    const Pose& truth = body.pose;
    if (is_sampled) {
      file_.write(frames_, now, foxglove::frame_transform(now, root, name, truth, body.height_m));
      file_.write(robots_[i].truth, now, foxglove::pose_in_frame(now, root, truth));
    }
    record_robot(robots_[i], name, now);
  }
}

void McapRecording::record_robot(OfRobot& robot, const std::string& name, Time now) {
  record_modules(robot, now);
  const std::string believed = name + "/position";
  if (const auto odometry = robot.posters.odometry())
    file_.write(robot.odometry, now, foxglove::pose_in_frame(odometry->position.date, root, odometry->position.pose));
  if (const auto fused = robot.posters.position()) {
    const Pose& pose = fused->position.pose;
    file_.write(robot.position, now, foxglove::pose_in_frame(fused->position.date, root, pose));
    file_.write(frames_, now, foxglove::frame_transform(fused->position.date, root, believed, pose));
  }
  for (std::size_t k = 0; k < robot.posters.lasers.size(); ++k) {
    RobotPosters::Laser& laser = robot.posters.lasers[k];
    const auto scan = robot.posters.scan(laser);
    if (!scan) continue;
    const std::string frame = name + "/" + laser.name;
    file_.write(
        frames_, now,
        foxglove::frame_transform(scan->date, believed, frame, laser.description.mount, laser.description.height_m));
    file_.write(robot.scans[k], now, foxglove::laser_scan(*scan, frame));
  }
}

void McapRecording::record_modules(OfRobot& robot, Time now) {
  for (const ModuleLog::Line& line : robot.modules->take())
    file_.write(robot.log, now, foxglove::log(line.date, line.module, line.text, line.is_bad));
}

void McapRecording::commit(const bridge::RunResult& result) {
  for (OfRobot& robot : robots_) record_modules(robot, Time() + result.simulated);
  for (const bridge::RobotResult& robot : result.robots) {
    const std::uint16_t goals = file_.add_channel(log_, "/" + robot.name + "/goals");
    for (const bridge::GoalResult& goal : robot.goals) {
      if (goal.report.empty()) continue;
      const std::string name = goal.name.empty() ? "goal" : goal.name;
      file_.write(
          goals, goal.date,
          foxglove::log(goal.date, robot.name,
                        fmt::format("{} ({:.2f}, {:.2f}): {}", name, goal.position.x, goal.position.y, goal.report)));
    }
  }
  file_.finish();
}

}  // namespace waitpoint::tools
