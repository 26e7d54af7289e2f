// SPDX-License-Identifier: BSD-3-Clause
// A picture of a replayed log: the echoes of its scans from the poses of the trajectory, as cells of a map, the path,
// that of the odometry alone, and the segments mapped by its localisation.
#pragma once

#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/playback/playback.hpp"

namespace waitpoint::tools {

/// An SVG document. `title` is its first line, `line` the one below.
std::string replay_picture_svg(const std::string& title, const std::string& line, const logs::SensorLog& log,
                               std::span<const playback::StampedPose> trajectory,
                               std::span<const playback::StampedPose> odometry, std::span<const bridge::Line> segments);

}  // namespace waitpoint::tools
