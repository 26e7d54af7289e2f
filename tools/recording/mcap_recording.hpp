// SPDX-License-Identifier: BSD-3-Clause
// A run for Foxglove and other viewers of MCAP files:
//
//   /tf               every robot's frames: world -> ROBOT (the truth), world -> ROBOT/position (what it believes), and
//                     ROBOT/position -> ROBOT/LASER
//   /world            the obstacles, again when they change
//   /clock            the virtual time, after each step of the world, ten times a second
//   /ROBOT/LASER      its scans, in the frame ROBOT/LASER
//   /ROBOT/odometry, /ROBOT/position, /ROBOT/truth    its poses
//   /ROBOT/modules    what its modules were asked, and what became of that, in words
//   /ROBOT/goals      what became of its goals, in words
#pragma once

#include "tools/recording/mcap_file.hpp"
#include "tools/recording/module_log.hpp"
#include "tools/recording/recording.hpp"
#include "tools/recording/robot_posters.hpp"

namespace waitpoint::tools {

class McapRecording final : public Recording {
 public:
  /// Throws BadInput if the file cannot be written.
  McapRecording(const std::filesystem::path& path, const bridge::Scenario& scenario);
  void begin(bridge::Experiment& experiment) override;

 private:
  struct OfRobot {
    RobotPosters posters;
    std::unique_ptr<ModuleLog> modules;
    std::vector<std::uint16_t> scans;  // channels
    std::uint16_t odometry, position, truth, log;
  };

  void record(const bridge::Experiment& experiment, Time now) override;
  void commit(const bridge::RunResult& result) override;
  void record_robot(OfRobot& robot, const std::string& name, Time now);
  void record_modules(OfRobot& robot, Time now);

  const bridge::Scenario& scenario_;
  McapFile file_;
  std::uint16_t transform_, scan_, log_, pose_, scene_, time_;  // schemas
  std::uint16_t frames_, world_, clock_;                        // channels
  std::vector<OfRobot> robots_;
  std::string drawn_;  // of the world, as it was recorded last
  std::optional<Time> sampled_;
};

}  // namespace waitpoint::tools
