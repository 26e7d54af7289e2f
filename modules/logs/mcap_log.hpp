// SPDX-License-Identifier: BSD-3-Clause
// MCAP files (mcap.dev, version 0), with messages of ROS 1, of ROS 2 in CDR, or of Foxglove's schemas in JSON; chunks
// may be compressed (lz4, zstd). Index and checksums are not needed.
#pragma once

#include <string_view>

#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

bool is_mcap(std::string_view bytes);
/// BadInput for a damaged file, and as TopicLog::finish().
SensorLog parse_mcap(const std::string& name, std::string_view bytes, const LogChoice& choice);

}  // namespace waitpoint::logs
