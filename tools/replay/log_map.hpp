// SPDX-License-Identifier: BSD-3-Clause
// A map of a replayed log, as ROS's map_server and scenarios read it: cells of 5 cm, occupied where echoes of the scans
// are, from the poses of the trajectory, free where beams passed, unknown elsewhere.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "modules/logs/sensor_log.hpp"
#include "modules/playback/playback.hpp"

namespace waitpoint::tools {

struct LogMap {
  std::string image;  ///< a grey map: PGM, binary
  std::string yaml;   ///< which names the image's file
};

/// `file` is that of the YAML; the image is to be beside it as image_of(file). BadInput, naming
/// the log, if it has no echoes at poses of the trajectory, or if the map would have more cells than a world may.
LogMap log_map(const std::filesystem::path& file, const logs::SensorLog& log,
               std::span<const playback::StampedPose> trajectory);

/// FILE.pgm for FILE.yaml.
std::filesystem::path image_of(const std::filesystem::path& file);

}  // namespace waitpoint::tools
