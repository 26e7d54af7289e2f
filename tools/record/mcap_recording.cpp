// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/mcap_recording.hpp"

#include <fmt/format.h>

#include "tools/record/foxglove.hpp"

namespace waitpoint::tools {
namespace {

std::uint16_t number_of(McapFile& file, const foxglove::Schema& schema) {
  return file.add_schema(schema.name, schema.text);
}

}  // namespace

McapRecording::McapRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : ViewerRecording(path, scenario),
      file_(path),
      transform_(number_of(file_, foxglove::frame_transform())),
      scan_(number_of(file_, foxglove::laser_scan())),
      log_(number_of(file_, foxglove::log())),
      pose_(number_of(file_, foxglove::pose_in_frame())),
      scene_(number_of(file_, foxglove::scene_update())),
      time_(number_of(file_, foxglove::clock())),
      frames_(file_.add_channel(transform_, "/tf")),
      world_(file_.add_channel(scene_, "/world")),
      clock_(file_.add_channel(time_, "/clock")) {
  for (const OfRobot& robot : robots()) add(robot);
}

void McapRecording::add(const OfRobot& robot) {
  const auto channel = [&](std::uint16_t schema, const std::string& topic) {
    return file_.add_channel(schema, "/" + robot.name + "/" + topic);
  };
  Channels& of = channels_.emplace_back();
  for (const RecordedLaser& laser : robot.lasers) of.scans.push_back(channel(scan_, laser.name));
  of.odometry = channel(pose_, "odometry");
  of.position = channel(pose_, "position");
  of.truth = channel(pose_, "truth");
  of.log = channel(log_, "modules");
}

void McapRecording::write_clock() { file_.write(clock_, now_, foxglove::clock(now_)); }

// Stamped with the time of the first message: equal worlds give equal texts.
void McapRecording::write_obstacles(const std::vector<world::Shape>& shapes) {
  file_.write(world_, now_, foxglove::scene_update(Time(), root, shapes));
}

void McapRecording::write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                                    double height_m) {
  file_.write(frames_, now_, foxglove::frame_transform(date, parent, child, pose, height_m));
}

void McapRecording::write_truth(const OfRobot& robot, Time date, const Pose& pose, double) {
  file_.write(channels_[robot.number].truth, now_, foxglove::pose_in_frame(date, root, pose));
}

void McapRecording::write_odometry(const OfRobot& robot, const posters::Odometry& odometry) {
  const posters::PositionEstimate& position = odometry.position;
  file_.write(channels_[robot.number].odometry, now_, foxglove::pose_in_frame(position.date, root, position.pose));
}

void McapRecording::write_position(const OfRobot& robot, const posters::PositionEstimate& position) {
  file_.write(channels_[robot.number].position, now_, foxglove::pose_in_frame(position.date, root, position.pose));
}

void McapRecording::write_scan(const OfRobot& robot, std::size_t laser, const std::string& frame,
                               const posters::LaserReading& scan) {
  file_.write(channels_[robot.number].scans[laser], now_, foxglove::laser_scan(scan, frame));
}

void McapRecording::write_log(const OfRobot& robot, const ModuleLog::Line& line) {
  file_.write(channels_[robot.number].log, now_, foxglove::log(line.date, line.module, line.text, line.is_bad));
}

void McapRecording::close(const bridge::RunResult& result) {
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
  if (result.outcome == bridge::Outcome::crashed) {
    const Time end = Time() + result.simulated;
    file_.write(file_.add_channel(log_, "/waitpoint"), end,
                foxglove::log(end, "waitpoint", "cut off: " + result.trouble, true));
  }
  file_.finish();
}

}  // namespace waitpoint::tools
