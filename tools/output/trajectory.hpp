// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in the format of the TUM RGB-D benchmark, as `evo` and others read it: a line `t x y z qx qy qz qw` for
// each pose, seconds and metres, the rotation as a quaternion about z.
//
// `--trajectory out.tum` writes the true path to out.tum, what the robot thought to out.estimated.tum and its odometry
// to out.odometry.tum; with several robots each has its own: out.NAME.tum, out.NAME.estimated.tum, ...
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

/// The lines of one path.
std::string tum_text(std::span<const bridge::DatedPose> path);

/// The files of one run, opened before it starts and written after it.
class TrajectoryFiles {
 public:
  /// Throws BadInput if one cannot be written.
  TrajectoryFiles(const std::filesystem::path& path, std::span<const std::string> robots);

  /// Writes and commits them all; the result has the robots named before, in that order.
  void write(const bridge::RunResult& result);

 private:
  struct OfRobot {
    OutputFile truth, estimate, odometry;
  };
  std::vector<OfRobot> robots_;
};

}  // namespace waitpoint::tools
