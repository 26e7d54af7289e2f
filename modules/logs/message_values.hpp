// SPDX-License-Identifier: BSD-3-Clause
// The values that a log of sensors takes from messages. BadInput, naming the message's `place`, for numbers beyond
// limits.hpp; ranges beyond theirs, below the least, and such as are no numbers, are infinite: no echoes.
#pragma once

#include <string>

#include "modules/logs/sensor_log.hpp"
#include "modules/messages/foxglove.hpp"
#include "modules/messages/nav_msgs.hpp"
#include "modules/messages/sensor_msgs.hpp"
#include "modules/messages/tf2_msgs.hpp"

namespace waitpoint::logs {

/// Without its place in the log; its range_max_m is 0 if the message has none.
LoggedScan scan_of(const std::string& place, const messages::sensor_msgs::LaserScan& message);
LoggedScan scan_of(const std::string& place, const messages::foxglove::LaserScan& message);

/// The message itself, if its numbers are within their limits.
const messages::geometry_msgs::Pose& checked(const std::string& place, const messages::geometry_msgs::Pose& pose);
const messages::geometry_msgs::Transform& checked(const std::string& place,
                                                  const messages::geometry_msgs::Transform& transform);

}  // namespace waitpoint::logs
