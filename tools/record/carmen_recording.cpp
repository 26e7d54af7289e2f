// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/carmen_recording.hpp"

#include <fmt/format.h>

namespace waitpoint::tools {
namespace {

std::string text(const Pose& pose) { return fmt::format("{:.6f} {:.6f} {:.6f}", pose.x, pose.y, pose.heading); }

// The time of the event, the robot, and the time of logging, which is the same.
std::string ending(Time time, const std::string& robot) {
  return fmt::format(" {0:.6f} {1} {0:.6f}\n", time.since_start().seconds(), robot);
}

}  // namespace

CarmenRecording::CarmenRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : Recording(path), scenario_(scenario), file_(path) {
  file_.write("# CARMEN Logfile\n");
}

void CarmenRecording::begin(run::Experiment& experiment) {
  for (std::size_t i = 0; i < scenario_.robots.size(); ++i)
    robots_.push_back({RobotPosters(scenario_.robots[i], *experiment.robots()[i]), std::nullopt});
}

void CarmenRecording::record(const run::Experiment& experiment, Time) {
  for (std::size_t i = 0; i < robots_.size(); ++i) record_robot(experiment, i);
}

void CarmenRecording::record_robot(const run::Experiment& experiment, std::size_t i) {
  OfRobot& robot = robots_[i];
  const std::string& name = scenario_.robots[i].name;
  if (const auto odometry = robot.posters.odometry()) {
    robot.odometry = odometry->position.pose;
    file_.write(fmt::format("ODOM {} {:.6f} {:.6f} 0", text(*robot.odometry), odometry->v_m_s, odometry->w_rad_s) +
                ending(odometry->position.date, name));
  }
  if (!robot.odometry || robot.posters.lasers.empty()) return;
  RobotPosters::Laser& laser = robot.posters.lasers.front();
  const auto scan = robot.posters.scan(laser);
  if (!scan) return;
  std::string line = fmt::format("FLASER {}", scan->range_m.size());
  for (const float range : scan->range_m) line += fmt::format(" {:.3f}", range);
  const Pose device = compose(*robot.odometry, laser.description.mount);
  file_.write(line + fmt::format(" {} {}", text(device), text(*robot.odometry)) + ending(scan->date, name));
  const Pose& truth = experiment.world().body(world::BodyId(static_cast<std::uint32_t>(i))).pose;
  file_.write(fmt::format("TRUEPOS {} {}", text(truth), text(*robot.odometry)) + ending(scan->date, name));
}

void CarmenRecording::commit(const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::crashed) file_.write("# cut off: " + result.trouble + "\n");
  file_.commit();
}

}  // namespace waitpoint::tools
