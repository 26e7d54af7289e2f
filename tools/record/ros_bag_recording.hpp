// SPDX-License-Identifier: BSD-3-Clause
// A run as a ROS 1 bag, for rviz and all other readers of bags:
//
//   /clock            rosgraph_msgs/Clock, ten times a second
//   /tf               tf2_msgs/TFMessage: world -> ROBOT (true), world -> ROBOT/position (estimated), and
//                     ROBOT/position -> ROBOT/SENSOR
//   /world            visualization_msgs/MarkerArray: the obstacles, again on every change
//   /ROBOT/SENSOR     messages of modules/messages/readings.hpp, or else the fields of the reading as numbers
//   /ROBOT/odometry   nav_msgs/Odometry
//   /ROBOT/position   geometry_msgs/PoseWithCovarianceStamped, the estimated pose
//   /ROBOT/truth      geometry_msgs/PoseStamped, ten times a second
//   topics of nodes   nav_msgs/Path, geometry_msgs/PoseArray, nav_msgs/OccupancyGrid, by their names
//   /ROBOT/modules    rosgraph_msgs/Log: requests to its modules and their outcomes
#pragma once

#include "tools/output/output_file.hpp"
#include "tools/record/ros_bag_file.hpp"
#include "tools/record/viewer_recording.hpp"

namespace waitpoint::tools {

class RosBagRecording final : public ViewerRecording {
 public:
  /// Throws BadInput if the file cannot be written.
  RosBagRecording(const std::filesystem::path& path, const scenario::Scenario& scenario);

 private:
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

  template <messages::Message M>
  void write(const std::string& topic, const M& message);
  void write_line(const std::string& topic, Time date, const std::string& writer, const std::string& text,
                  bool is_warning);

  OutputFile file_;
  std::unique_ptr<RosBagFile> bag_;
  Time now_;  // at which the following messages are received
};

}  // namespace waitpoint::tools
