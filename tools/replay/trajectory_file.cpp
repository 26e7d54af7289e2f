// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/trajectory_file.hpp"

#include <fmt/format.h>

#include <map>

#include "tools/output/trajectory.hpp"

namespace waitpoint::tools {
namespace {

using playback::StampedPose;

std::string text(const Pose& pose) { return fmt::format("{:.6f} {:.6f} {:.6f}", pose.x, pose.y, pose.heading); }

std::string carmen_text(const logs::SensorLog& log, std::span<const StampedPose> trajectory,
                        std::span<const StampedPose> odometry) {
  std::map<std::size_t, Pose> by_scan;
  for (const StampedPose& at : odometry) by_scan[at.scan] = at.pose;
  std::string lines = "# CARMEN Logfile\n";
  for (const StampedPose& at : trajectory) {
    const logs::LoggedScan& scan = log.scans[at.scan];
    lines += fmt::format("FLASER {}", scan.range_m.size());
    for (const float range : scan.range_m) lines += fmt::format(" {:.3f}", range);
    lines += fmt::format(" {} {} {} waitpoint {}\n", text(compose(at.pose, log.mount)), text(by_scan[at.scan]),
                         to_string(at.stamp), to_string(at.stamp));
  }
  return lines;
}

}  // namespace

std::string trajectory_text(const std::filesystem::path& file, const logs::SensorLog& log,
                            std::span<const StampedPose> trajectory, std::span<const StampedPose> odometry) {
  if (file.extension() == ".log") return carmen_text(log, trajectory, odometry);
  std::string lines;
  for (const StampedPose& at : trajectory) lines += tum_line({at.stamp, at.pose});
  return lines;
}

}  // namespace waitpoint::tools
