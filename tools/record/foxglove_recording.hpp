// SPDX-License-Identifier: BSD-3-Clause
// A run as an MCAP file for Foxglove and other viewers:
//
//   /tf               every robot's frames: world -> ROBOT (true), world -> ROBOT/position (estimated), and
//                     ROBOT/position -> ROBOT/SENSOR
//   /world            the obstacles, again on every change
//   /clock            the virtual time, after each step of the world, ten times a second
//   /ROBOT/SENSOR     the readings of a sensor (world/sensors/types), by their declared fields; a laser's scans, in the
//                     frame ROBOT/SENSOR
//   /ROBOT/odometry, /ROBOT/position, /ROBOT/truth    its poses
//   /ROBOT/modules    requests to its modules and their outcomes, in words
//   topics of nodes   paths and clouds as poses, grids as boxes
//   /ROBOT/goals      outcomes of its goals, in words; when the run is over
#pragma once

#include <map>

#include "tools/record/foxglove_messages.hpp"
#include "tools/record/mcap_file.hpp"
#include "tools/record/viewer_recording.hpp"

namespace waitpoint::tools {

class FoxgloveRecording final : public ViewerRecording {
 public:
  /// Throws BadInput if the file cannot be written.
  FoxgloveRecording(const std::filesystem::path& path, const scenario::Scenario& scenario);

 private:
  /// Of messages of one type.
  template <messages::Message M>
  struct Channel {
    McapFile::Topic number = 0;
  };
  /// Of one robot.
  struct Topics {
    Channel<foxglove::PoseInFrame> odometry, position, truth;
    Channel<foxglove::Log> log;
  };

  template <messages::Message M>
  Channel<M> add(const std::string& topic);
  template <messages::Message M>
  void write(Channel<M> channel, Time received, const M& message);

  void add_topics(const OfRobot& robot);
  void set_time(Time now) override { now_ = now; }
  void write_clock() override;
  void write_obstacles(const std::vector<world::Shape>& shapes) override;
  void write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                       double height_m) override;
  void write_truth(const OfRobot& robot, Time date, const Pose& pose, double height_m) override;
  void write_odometry(const OfRobot& robot, const posters::Odometry& odometry) override;
  void write_position(const OfRobot& robot, const posters::PositionEstimate& position) override;
  void write_reading(const AnyNewReading& reading) override;
  void write_shown(const nodes::ShownMessage& message, const std::string& frame) override;
  void write_log(const OfRobot& robot, const ModuleLog::Line& line) override;
  void close(const bridge::RunResult& result) override;
  void write_pose(Channel<foxglove::PoseInFrame> channel, Time date, const Pose& pose);
  void write_goals(const bridge::RobotResult& robot);

  McapFile file_;
  Channel<foxglove::FrameTransform> frames_;
  Channel<foxglove::SceneUpdate> world_;
  Channel<foxglove::Clock> clock_;
  std::vector<Topics> topics_;  // by robot
  std::map<std::string, Channel<foxglove::SceneUpdate>> grids_;
  std::map<std::string, Channel<foxglove::PosesInFrame>> poses_;
  std::map<std::string, McapFile::Topic> readings_;  // by topic
  Time now_;
};

}  // namespace waitpoint::tools
