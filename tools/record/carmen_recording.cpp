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
    : Recording(path), file_(path) {
  file_.write("# CARMEN Logfile\n");
  for (const scenario::RobotScenario& robot : scenario.robots) {
    OfRobot& added = robots_.emplace_back(OfRobot{robot.name});
    if (const auto lasers = recorded_sensors<world::Lasers>(robot); !lasers.empty())
      added.mount = lasers.front().description.mount;
  }
}

void CarmenRecording::record(const StepNews& step) {
  for (const RobotNews& news : step.robots) record_robot(news);
}

void CarmenRecording::record_robot(const RobotNews& news) {
  OfRobot& robot = robots_[news.robot];
  if (const auto& odometry = news.odometry) {
    robot.odometry = odometry->position.pose;
    file_.write(fmt::format("ODOM {} {:.6f} {:.6f} 0", text(*robot.odometry), odometry->v_m_s, odometry->w_rad_s) +
                ending(odometry->position.date, robot.name));
  }
  if (robot.mount)
    if (const auto& scan = news.readings.of<world::Lasers>().front()) robot.scan = scan;
  if (!robot.odometry || !robot.scan) return;
  const posters::LaserReading& scan = *robot.scan;
  std::string line = fmt::format("FLASER {}", scan.range_m.size());
  for (const float range : scan.range_m) line += fmt::format(" {:.3f}", range);
  const Pose device = compose(*robot.odometry, *robot.mount);
  file_.write(line + fmt::format(" {} {}", text(device), text(*robot.odometry)) + ending(scan.date, robot.name));
  file_.write(fmt::format("TRUEPOS {} {}", text(news.pose), text(*robot.odometry)) + ending(scan.date, robot.name));
  robot.scan.reset();
}

void CarmenRecording::commit(const StepNews&, const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::crashed) file_.write("# cut off: " + result.trouble + "\n");
  file_.commit();
}

}  // namespace waitpoint::tools
