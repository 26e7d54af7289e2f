// SPDX-License-Identifier: BSD-3-Clause
// The new readings of a robot's sensors for recordings: of all types (world/sensors/types/sensors.hpp), of the devices
// that the robot's bridge has posters for.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "modules/scenario/scenario.hpp"
#include "tools/record/new_values.hpp"
#include "world/sensors/types/sensors.hpp"

namespace waitpoint::tools {

/// A sensor with a poster.
template <class S>
struct RecordedSensor {
  std::string name, poster;
  typename S::Description description;
};

template <class S>
std::vector<RecordedSensor<S>> recorded_sensors(const scenario::RobotScenario& robot) {
  std::vector<RecordedSensor<S>> sensors;
  for (const scenario::BridgeRow& row : robot.bridge)
    for (std::size_t i = 0; i < robot.body.equipment.count<S>(); ++i)
      if (const std::string name = robot.device_name<S>(i); row.device == name + ".reading")
        sensors.push_back({name, row.poster, robot.body.equipment.description<S>(i)});
  return sensors;
}

/// By recorded sensor: the reading, if it is new.
template <class S>
using NewReadingsOf = std::vector<std::optional<typename S::Reading>>;

struct NewReadings {
  world::Sensors::Tuple<NewReadingsOf> each;

  template <class S>
  const NewReadingsOf<S>& of() const {
    return std::get<NewReadingsOf<S>>(each);
  }
};
void carry(auto& archive, NewReadings& readings) {
  std::apply([&](auto&... each) { archive(each...); }, readings.each);
}

class ReadingPosters {
 public:
  ReadingPosters(const scenario::RobotScenario& robot, const genom::NameSpace& names) {
    world::Sensors::for_each([&]<class S>() {
      for (const RecordedSensor<S>& sensor : recorded_sensors<S>(robot))
        std::get<Posters<S>>(each_).emplace_back(names, sensor.poster);
    });
  }

  template <class S>
  NewReadingsOf<S> take() {
    NewReadingsOf<S> readings;
    for (auto& poster : std::get<Posters<S>>(each_))
      readings.push_back(poster.take([](const typename S::Reading& reading) { return reading.date; }));
    return readings;
  }
  NewReadings take_all() {
    NewReadings readings;
    world::Sensors::for_each([&]<class S>() { std::get<NewReadingsOf<S>>(readings.each) = take<S>(); });
    return readings;
  }

 private:
  template <class S>
  using Posters = std::vector<NewValues<typename S::Reading>>;

  world::Sensors::Tuple<Posters> each_;
};

}  // namespace waitpoint::tools
