// SPDX-License-Identifier: BSD-3-Clause
// The trajectory of a replayed log as a file, with the log's own stamps: in the format of the TUM RGB-D benchmark
// (`stamp x y z qx qy qz qw`), or by a name that ends in .log as a corrected log of CARMEN: FLASER records with the
// scans, the laser's pose by the trajectory, and the odometry.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "modules/logs/sensor_log.hpp"
#include "modules/playback/playback.hpp"

namespace waitpoint::tools {

/// The contents of the file named `file`. `odometry` has the odometry of the same scans.
std::string trajectory_text(const std::filesystem::path& file, const logs::SensorLog& log,
                            std::span<const playback::StampedPose> trajectory,
                            std::span<const playback::StampedPose> odometry);

}  // namespace waitpoint::tools
