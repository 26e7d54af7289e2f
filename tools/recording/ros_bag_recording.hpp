// SPDX-License-Identifier: BSD-3-Clause
// A run as a ROS 1 bag, for rviz and everything else that reads bags:
//
//   /clock            rosgraph_msgs/Clock, ten times a second
//   /tf               tf2_msgs/TFMessage: world -> ROBOT (the truth), world -> ROBOT/position (what it believes), and
//                     ROBOT/position -> ROBOT/LASER
//   /world            visualization_msgs/MarkerArray: the obstacles, again when they change
//   /ROBOT/LASER      sensor_msgs/LaserScan, in the frame ROBOT/LASER
//   /ROBOT/odometry   nav_msgs/Odometry
//   /ROBOT/position   geometry_msgs/PoseWithCovarianceStamped, what it believes
//   /ROBOT/truth      geometry_msgs/PoseStamped, ten times a second
//   /ROBOT/modules    rosgraph_msgs/Log: what its modules were asked, and what became of that
#pragma once

#include "tools/output_file.hpp"
#include "tools/recording/module_log.hpp"
#include "tools/recording/recording.hpp"
#include "tools/recording/robot_posters.hpp"
#include "tools/recording/ros_bag_file.hpp"

namespace waitpoint::tools {

class RosBagRecording final : public Recording {
 public:
  /// Throws BadInput if the file cannot be written.
  RosBagRecording(const std::filesystem::path& path, const bridge::Scenario& scenario);
  void begin(bridge::Experiment& experiment) override;

 private:
  struct OfRobot {
    std::string name;
    RobotPosters posters;
    std::unique_ptr<ModuleLog> modules;
  };

  void record(const bridge::Experiment& experiment, Time now) override;
  void commit(const bridge::RunResult& result) override;
  void record_robot(OfRobot& robot);
  void record_modules(OfRobot& robot);
  void record_world(const std::vector<world::Obstacle>& obstacles);

  const bridge::Scenario& scenario_;
  OutputFile file_;
  std::unique_ptr<RosBagFile> bag_;
  std::vector<OfRobot> robots_;
  std::vector<RosBagFile::Solid> drawn_;  // as they were recorded last
  std::optional<Time> sampled_;
};

}  // namespace waitpoint::tools
