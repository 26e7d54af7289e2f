// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/foxglove_recording.hpp"

#include <fmt/format.h>

#include "tools/output/occupied_shapes.hpp"
#include "tools/record/foxglove.hpp"

namespace waitpoint::tools {

FoxgloveRecording::FoxgloveRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : ViewerRecording(path, scenario),
      file_(path),
      frames_(file_.add(foxglove::frame_transform(), "/tf")),
      world_(file_.add(foxglove::scene_update(), "/world")),
      clock_(file_.add(foxglove::clock(), "/clock")) {
  topics_.reserve(robots().size());
  for (const OfRobot& robot : robots()) add_topics(robot);
}

void FoxgloveRecording::add_topics(const OfRobot& robot) {
  const auto topic = [&](const foxglove::Schema& schema, const std::string& name) {
    return file_.add(schema, "/" + robot.name + "/" + name);
  };
  Topics& of = topics_.emplace_back();
  of.scans.reserve(robot.lasers.size());
  for (const RecordedLaser& laser : robot.lasers) of.scans.push_back(topic(foxglove::laser_scan(), laser.name));
  of.odometry = topic(foxglove::pose_in_frame(), "odometry");
  of.position = topic(foxglove::pose_in_frame(), "position");
  of.truth = topic(foxglove::pose_in_frame(), "truth");
  of.log = topic(foxglove::log(), "modules");
}

void FoxgloveRecording::write_clock() { file_.write(clock_, now_, foxglove::clock(now_)); }

// Stamped with the time of the first message: equal worlds give equal texts.
void FoxgloveRecording::write_obstacles(const std::vector<world::Shape>& shapes) {
  file_.write(world_, now_, foxglove::scene_update(Time(), root, shapes));
}

void FoxgloveRecording::write_transform(Time date, const std::string& parent, const std::string& child,
                                        const Pose& pose, double height_m) {
  file_.write(frames_, now_, foxglove::frame_transform(date, parent, child, pose, height_m));
}

void FoxgloveRecording::write_truth(const OfRobot& robot, Time date, const Pose& pose, double) {
  const Topic topic = topics_[robot.number].truth;
  file_.write(topic, now_, foxglove::pose_in_frame(date, root, pose));
}

void FoxgloveRecording::write_odometry(const OfRobot& robot, const posters::Odometry& odometry) {
  const Topic topic = topics_[robot.number].odometry;
  const posters::PositionEstimate& position = odometry.position;
  file_.write(topic, now_, foxglove::pose_in_frame(position.date, root, position.pose));
}

void FoxgloveRecording::write_position(const OfRobot& robot, const posters::PositionEstimate& position) {
  const Topic topic = topics_[robot.number].position;
  file_.write(topic, now_, foxglove::pose_in_frame(position.date, root, position.pose));
}

void FoxgloveRecording::write_scan(const OfRobot& robot, std::size_t laser, const std::string& frame,
                                   const posters::LaserReading& scan) {
  const Topic topic = topics_[robot.number].scans[laser];
  file_.write(topic, now_, foxglove::laser_scan(scan, frame));
}

void FoxgloveRecording::write_shown(const nodes::ShownMessage& message, const std::string& frame) {
  const bool is_grid = message.kind == nodes::ShownMessage::Kind::grid;
  const auto [topic, is_new] = shown_.try_emplace(message.topic, Topic());
  if (is_new) topic->second = file_.add(is_grid ? foxglove::scene_update() : foxglove::poses_in_frame(), message.topic);
  file_.write(topic->second, now_,
              is_grid ? foxglove::scene_update(message.date, frame, occupied_shapes(message))
                      : foxglove::poses_in_frame(message.date, frame, message.poses));
}

void FoxgloveRecording::write_log(const OfRobot& robot, const ModuleLog::Line& line) {
  const Topic topic = topics_[robot.number].log;
  file_.write(topic, now_, foxglove::log(line.date, line.module, line.text, line.is_bad));
}

void FoxgloveRecording::close(const bridge::RunResult& result) {
  for (const bridge::RobotResult& robot : result.robots) write_goals(robot);
  if (result.outcome == bridge::Outcome::crashed) {
    const Time end = Time() + result.simulated;
    file_.write(file_.add(foxglove::log(), "/waitpoint"), end,
                foxglove::log(end, "waitpoint", "cut off: " + result.trouble, true));
  }
  file_.finish();
}

void FoxgloveRecording::write_goals(const bridge::RobotResult& robot) {
  const Topic goals = file_.add(foxglove::log(), "/" + robot.name + "/goals");
  for (const bridge::GoalResult& goal : robot.goals) {
    if (goal.report.empty()) continue;
    const std::string name = goal.name.empty() ? "goal" : goal.name;
    const std::string words =
        fmt::format("{} ({:.2f}, {:.2f}): {}", name, goal.position.x, goal.position.y, goal.report);
    file_.write(goals, goal.date, foxglove::log(goal.date, robot.name, words));
  }
}

}  // namespace waitpoint::tools
