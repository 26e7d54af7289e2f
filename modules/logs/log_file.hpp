// SPDX-License-Identifier: BSD-3-Clause
// Reads a log of sensors in any of the known formats, which are told apart by their contents, not by their names.
#pragma once

#include <filesystem>

#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

/// BadInput if the file cannot be read, is damaged, has no scans or no odometry, or if `choice` does not determine
/// what to take.
SensorLog read_log(const std::filesystem::path& file, const LogChoice& choice);

/// The same for the contents of a file; `name` is for messages.
SensorLog parse_log(const std::string& name, std::string contents, const LogChoice& choice);

}  // namespace waitpoint::logs
