// SPDX-License-Identifier: BSD-3-Clause
// ROS 1 bags, version 2.0: records of a header, fields "name=value" after their lengths, and data. Messages and the
// connections that describe them are in chunks, which may be compressed (none, bz2, lz4). The index is not needed.
#pragma once

#include <string_view>

#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

bool is_ros_bag(std::string_view bytes);
/// BadInput for a damaged bag, and as TopicLog::finish().
SensorLog parse_ros_bag(const std::string& name, std::string_view bytes, const LogChoice& choice);

}  // namespace waitpoint::logs
