// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in the format of the TUM RGB-D benchmark, for `evo` and others: a line `t x y z qx qy qz qw` per pose,
// in seconds and metres, with the rotation as a quaternion about z.
//
// `--trajectory out.tum` writes the true path to out.tum, the estimated one to out.estimated.tum and odometry to
// out.odometry.tum; several robots have a file each: out.NAME.tum, out.NAME.estimated.tum, ... Every sample is written
// as it comes: a long run takes no more memory than a short one.
#pragma once

#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "modules/bridge/path.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

/// The line of one pose.
std::string tum_line(const bridge::DatedPose& at);

/// The files of --trajectory PATH: for each robot those of the true, the estimated and the odometry's path. Without
/// robots: those of a single one, whose name does not matter.
std::vector<std::filesystem::path> trajectory_names(const std::filesystem::path& path,
                                                    std::span<const std::string> robots);

/// The files of one run, opened before it starts and named after it.
class TrajectoryFiles {
 public:
  /// Throws BadInput if a file cannot be written.
  TrajectoryFiles(const std::filesystem::path& path, std::span<const std::string> robots);

  /// Writes the paths of the robot with this index among those given.
  bridge::PathSink& sink(std::size_t robot) { return robots_.at(robot); }

  /// Commits all files. Throws BadInput if one could not be written, also earlier.
  void finish();
  /// The same, after a comment at the end of each: the process dies for `reason`.
  void cut_off(const std::string& reason);

 private:
  class OfRobot final : public bridge::PathSink {
   public:
    /// By kind.
    explicit OfRobot(std::span<const std::filesystem::path> names);
    void add(bridge::PathKind kind, const bridge::DatedPose& sample) override;
    void finish(const std::string& end);

   private:
    OutputFile& file(bridge::PathKind kind) { return files_[static_cast<std::size_t>(kind)]; }

    std::vector<OutputFile> files_;  // by kind
    std::exception_ptr failure_;
  };
  std::vector<OfRobot> robots_;
};

}  // namespace waitpoint::tools
