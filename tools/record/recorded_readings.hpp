// SPDX-License-Identifier: BSD-3-Clause
// The new readings of a robot's sensors for recordings: of all types that are read alone
// (world/sensors/types/sensors.hpp) and that the robot's bridge has a poster for.
#pragma once

#include <optional>
#include <tuple>

#include "modules/scenario/scenario.hpp"
#include "tools/record/new_values.hpp"
#include "world/sensors/types/sensors.hpp"

namespace waitpoint::tools {

template <class S>
using NewReading = std::optional<typename S::Reading>;

/// By sensor type: the reading, if it is new.
struct NewReadings {
  world::SensorsReadAlone::Tuple<NewReading> each;

  template <class S>
  const NewReading<S>& of() const {
    return std::get<NewReading<S>>(each);
  }
};
void carry(auto& archive, NewReadings& readings) {
  std::apply([&](auto&... each) { archive(each...); }, readings.each);
}

class ReadingPosters {
 public:
  ReadingPosters(const scenario::RobotScenario& robot, const genom::NameSpace& names) {
    world::SensorsReadAlone::for_each([&]<class S>() {
      for (const scenario::BridgeRow& row : robot.bridge)
        if (row.device == world::device_value<S>()) std::get<Poster<S>>(each_).emplace(names, row.poster);
    });
  }

  NewReadings take() {
    NewReadings readings;
    world::SensorsReadAlone::for_each([&]<class S>() {
      if (auto& poster = std::get<Poster<S>>(each_))
        std::get<NewReading<S>>(readings.each) =
            poster->take([](const typename S::Reading& reading) { return reading.date; });
    });
    return readings;
  }

 private:
  template <class S>
  using Poster = std::optional<NewValues<typename S::Reading>>;

  world::SensorsReadAlone::Tuple<Poster> each_;
};

}  // namespace waitpoint::tools
