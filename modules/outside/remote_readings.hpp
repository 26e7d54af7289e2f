// SPDX-License-Identifier: BSD-3-Clause
// The readings of a robot in a world that another process serves, as they came last.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/scenario/location.hpp"
#include "world/world.hpp"

namespace waitpoint::outside {

struct RemoteReadings {
  world::BodyState body;
  world::OdometerReading odometer;
  world::BatteryState battery;
  std::vector<std::optional<world::LaserScan>> scans;  ///< by laser
  std::uint64_t steps = 0;                             ///< that have come

  /// Takes one line of the server; `lasers` are the names of the robot's. Other lines than readings are ignored. Throws
  /// BadInput at `written` for a malformed one.
  void take(std::string_view line, const std::vector<std::string>& lasers, const scenario::Location& written);
};

}  // namespace waitpoint::outside
