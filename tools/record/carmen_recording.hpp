// SPDX-License-Identifier: BSD-3-Clause
// A run as a log of CARMEN, which SLAM tools read (carmen.sourceforge.net, "logger message formats"):
//
//   FLASER n r1 ... rn x y theta odom_x odom_y odom_theta time ROBOT time
//   ODOM x y theta v w 0 time ROBOT time
//   TRUEPOS x y theta odom_x odom_y odom_theta time ROBOT time
//
// The laser's pose is in the odometry's frame. The format supports one laser: each robot's first one is recorded.
#pragma once

#include "tools/output/output_file.hpp"
#include "tools/record/recording.hpp"
#include "tools/record/robot_posters.hpp"

namespace waitpoint::tools {

class CarmenRecording final : public Recording {
 public:
  /// Throws BadInput if the file cannot be written.
  CarmenRecording(const std::filesystem::path& path, const scenario::Scenario& scenario);

  bool shows_obstacles() const override { return false; }

 private:
  struct OfRobot {
    std::string name;
    std::optional<Pose> mount{};  ///< of its first laser
    std::optional<Pose> odometry{};
    std::optional<posters::LaserReading> scan{};  ///< not written
  };

  void record(const StepNews& step) override;
  void commit(const StepNews& last, const bridge::RunResult& result) override;
  void record_robot(const RobotNews& news);

  OutputFile file_;
  std::vector<OfRobot> robots_;
};

}  // namespace waitpoint::tools
