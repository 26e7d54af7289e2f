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

class Values;

class RemoteReadings {
 public:
  /// `robot` must outlive it.
  explicit RemoteReadings(const scenario::RobotScenario& robot);

  /// Takes one line of the server of the robot. Other lines than readings are ignored. Throws BadInput at `written` for
  /// a malformed one, such as a scan with other beams than the scenario's laser has.
  void take(std::string_view line, const scenario::Location& written);

  /// By sensor of type S; null before the first reading.
  template <class S>
  std::vector<std::optional<typename S::Reading>>& of() {
    return std::get<Readings<S>>(sensors_);
  }

  world::BodyState body;
  world::OdometerReading odometer;
  std::uint64_t steps = 0;  ///< that have come

 private:
  template <class S>
  using Readings = std::vector<std::optional<typename S::Reading>>;

  void take_reading(std::string_view kind, const Values& values, const scenario::Location& written);

  const scenario::RobotScenario& robot_;
  world::Sensors::Tuple<Readings> sensors_;
};

}  // namespace waitpoint::outside
