// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/viewer_recording.hpp"

#include "modules/messages/readings.hpp"

namespace waitpoint::tools {

ViewerRecording::ViewerRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : Recording(path) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    OfRobot& robot = robots_.emplace_back(OfRobot{i, scenario.robots[i].name, {}});
    world::Sensors::for_each(
        [&]<class S>() { std::get<RecordedSensors<S>>(robot.sensors) = recorded_sensors<S>(scenario.robots[i]); });
  }
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
  world::Sensors::for_each([&]<class S>() { record_readings<S>(robot, news.readings); });
}

template <class S>
void ViewerRecording::record_readings(const OfRobot& robot, const NewReadings& readings) {
  for (std::size_t k = 0; k < readings.of<S>().size(); ++k) {
    const auto& reading = readings.of<S>()[k];
    if (!reading) continue;
    const RecordedSensor<S>& sensor = std::get<RecordedSensors<S>>(robot.sensors)[k];
    const std::string device = robot.name + "/" + sensor.name;
    const auto mounts = messages::mounts_of(sensor.description);
    for (const messages::Mount& mount : mounts)
      write_transform(reading->date, robot.name + "/position", device + mount.suffix, mount.pose, mount.height_m);
    const std::string frame = requires { S::in_world_frame; }
    ? root : mounts.empty() ? robot.name : device;
    write_reading(NewReading<S>{"/" + device, frame, sensor.description, *reading});
  }
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
