// SPDX-License-Identifier: BSD-3-Clause
// A run for Foxglove and other viewers of MCAP files:
//
//   /tf               every robot's frames: world -> ROBOT (true), world -> ROBOT/position (estimated), and
//                     ROBOT/position -> ROBOT/LASER
//   /world            the obstacles, again on every change
//   /clock            the virtual time, after each step of the world, ten times a second
//   /ROBOT/LASER      its scans, in the frame ROBOT/LASER
//   /ROBOT/odometry, /ROBOT/position, /ROBOT/truth    its poses
//   /ROBOT/modules    requests to its modules and their outcomes, in words
//   /ROBOT/goals      outcomes of its goals, in words
#pragma once

#include "tools/record/mcap_file.hpp"
#include "tools/record/viewer_recording.hpp"

namespace waitpoint::tools {

class McapRecording final : public ViewerRecording {
 public:
  /// Throws BadInput if the file cannot be written.
  McapRecording(const std::filesystem::path& path, const scenario::Scenario& scenario);

 private:
  /// Of one robot.
  struct Channels {
    std::vector<std::uint16_t> scans;
    std::uint16_t odometry, position, truth, log;
  };

  void add(const OfRobot& robot);
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
  void write_log(const OfRobot& robot, const ModuleLog::Line& line) override;
  void close(const bridge::RunResult& result) override;

  McapFile file_;
  std::uint16_t transform_, scan_, log_, pose_, scene_, time_;  // schemas
  std::uint16_t frames_, world_, clock_;                        // channels
  std::vector<Channels> channels_;                              // by robot
  Time now_;
};

}  // namespace waitpoint::tools
