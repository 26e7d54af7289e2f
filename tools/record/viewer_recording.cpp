// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/viewer_recording.hpp"

namespace waitpoint::tools {

ViewerRecording::ViewerRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : Recording(path) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    robots_.push_back({i, scenario.robots[i].name, recorded_lasers(scenario.robots[i])});
}

void ViewerRecording::record(const StepNews& step) {
  set_time(step.now);
  if (step.is_sampled) write_clock();
  if (step.obstacles) write_obstacles(*step.obstacles);
  for (const RobotNews& news : step.robots) {
    const OfRobot& robot = robots_[news.robot];
    if (step.is_sampled) record_truth(robot, news, step.now);
    record_news(robot, news);
  }
  for (const nodes::ShownMessage& message : step.shown)
    write_shown(message, message.frame == "map" || message.frame.empty() ? root : message.frame);
}

void ViewerRecording::record_truth(const OfRobot& robot, const RobotNews& news, Time now) {
  write_transform(now, root, robot.name, news.pose, news.height_m);
  write_truth(robot, now, news.pose, news.height_m);
}

void ViewerRecording::record_news(const OfRobot& robot, const RobotNews& news) {
  record_lines(robot, news);
  const std::string believed = robot.name + "/position";
  if (news.odometry) write_odometry(robot, *news.odometry);
  if (news.position) {
    write_position(robot, *news.position);
    write_transform(news.position->date, root, believed, news.position->pose, 0);
  }
  for (std::size_t k = 0; k < news.scans.size(); ++k) {
    if (!news.scans[k]) continue;
    const RecordedLaser& laser = robot.lasers[k];
    const std::string frame = robot.name + "/" + laser.name;
    write_transform(news.scans[k]->date, believed, frame, laser.description.mount, laser.description.height_m);
    write_scan(robot, k, frame, *news.scans[k]);
  }
  write_readings(robot, news.readings);
}

void ViewerRecording::record_lines(const OfRobot& robot, const RobotNews& news) {
  for (const ModuleLog::Line& line : news.lines) write_log(robot, line);
}

void ViewerRecording::commit(const StepNews& last, const bridge::RunResult& result) {
  set_time(last.now);
  for (const RobotNews& news : last.robots) record_lines(robots_[news.robot], news);
  close(result);
}

}  // namespace waitpoint::tools
