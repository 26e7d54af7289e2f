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

  void begin(run::Experiment& experiment) override;

 private:
  struct OfRobot {
    RobotPosters posters;
    std::optional<Pose> odometry;
  };

  void record(const run::Experiment& experiment, Time now) override;
  void commit(const bridge::RunResult& result) override;
  void record_robot(const run::Experiment& experiment, std::size_t i);

  const scenario::Scenario& scenario_;
  OutputFile file_;
  std::vector<OfRobot> robots_;
};

}  // namespace waitpoint::tools
