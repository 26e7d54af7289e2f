// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in the format of the TUM RGB-D benchmark, for `evo` and others: a line `t x y z qx qy qz qw` per pose,
// in seconds and metres, with the rotation as a quaternion about z.
//
// `--trajectory out.tum` writes the true path to out.tum, the estimated one to out.estimated.tum and odometry to
// out.odometry.tum; several robots have a file each: out.NAME.tum, out.NAME.estimated.tum, ...
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
  /// Throws BadInput if a file cannot be written.
  TrajectoryFiles(const std::filesystem::path& path, std::span<const std::string> robots);

  /// Writes and commits all files; the result has the robots given before, in that order. Of a crashed run they end
  /// with a comment that says so.
  void write(const bridge::RunResult& result);

 private:
  struct OfRobot {
    OutputFile truth, estimate, odometry;
  };
  std::vector<OfRobot> robots_;
};

}  // namespace waitpoint::tools
