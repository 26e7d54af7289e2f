// SPDX-License-Identifier: BSD-3-Clause
// The readings of a robot in a world that another process serves, as they came last.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/scenario/location.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::outside {

struct RemoteReadings {
  world::BodyState body;
  world::OdometerReading odometer;
  world::BatteryState battery;
  std::vector<std::optional<world::LaserScan>> scans;  ///< by laser
  std::uint64_t steps = 0;                             ///< that have come

  /// Takes one line of the server of `robot`. Other lines than readings are ignored. Throws BadInput at `written` for a
  /// malformed one, such as a scan with other beams than the scenario's laser has.
  void take(std::string_view line, const scenario::RobotScenario& robot, const scenario::Location& written);
};

}  // namespace waitpoint::outside
