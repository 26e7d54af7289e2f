// SPDX-License-Identifier: BSD-3-Clause
// A run for Foxglove and other viewers, as a file or live:
//
//   /tf               every robot's frames: world -> ROBOT (true), world -> ROBOT/position (estimated), and
//                     ROBOT/position -> ROBOT/LASER
//   /world            the obstacles, again on every change
//   /clock            the virtual time, after each step of the world, ten times a second
//   /ROBOT/LASER      its scans, in the frame ROBOT/LASER
//   /ROBOT/odometry, /ROBOT/position, /ROBOT/truth    its poses
//   /ROBOT/modules    requests to its modules and their outcomes, in words
//   topics of nodes   paths and clouds as poses, grids as boxes
//   /ROBOT/goals      outcomes of its goals, in words; when the run is over
//
// A message is made only if the sink wants it.
#pragma once

#include <map>
#include <memory>

#include "tools/record/topic_sink.hpp"
#include "tools/record/viewer_recording.hpp"

namespace waitpoint::tools {

class FoxgloveRecording final : public ViewerRecording {
 public:
  /// `path` is for messages.
  FoxgloveRecording(const std::filesystem::path& path, const scenario::Scenario& scenario,
                    std::unique_ptr<TopicSink> sink);

 private:
  using Topic = TopicSink::Topic;
  /// Of one robot.
  struct Topics {
    std::vector<Topic> scans;
    Topic odometry, position, truth, log;
  };

  void add_topics(const OfRobot& robot);
  void set_time(Time now) override { now_ = now; }
  void write_clock() override;
  void write_obstacles(const std::vector<world::Shape>& shapes) override;
  void write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                       double height_m) override;
  void write_truth(const OfRobot& robot, Time date, const Pose& pose, double height_m) override;
  void write_odometry(const OfRobot& robot, const posters::Odometry& odometry) override;
  void write_position(const OfRobot& robot, const posters::PositionEstimate& position) override;
  void write_scan(const OfRobot& robot, std::size_t laser, const std::string& frame,
                  const posters::LaserReading& scan) override;
  void write_shown(const nodes::ShownMessage& message, const std::string& frame) override;
  void write_log(const OfRobot& robot, const ModuleLog::Line& line) override;
  void close(const bridge::RunResult& result) override;
  void write_goals(const bridge::RobotResult& robot);

  std::unique_ptr<TopicSink> sink_;
  Topic frames_, world_, clock_;
  std::vector<Topics> topics_;  // by robot
  std::map<std::string, Topic> shown_;
  Time now_;
};

}  // namespace waitpoint::tools
