// SPDX-License-Identifier: BSD-3-Clause
// New values of a robot's posters, for recordings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/bridge/robot.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::tools {

/// One poster; if the robot does not have it, there are never new values.
template <class Value>
class NewValues {
 public:
  NewValues(const genom::NameSpace& names, const std::string& poster)
      : poster_(dynamic_cast<const genom::Poster<Value>*>(names.find_poster(poster))) {}

  /// The value, if its date differs from that of the last one taken.
  template <class DateOf>
  std::optional<Value> take(DateOf date_of) {
    std::optional<Value> value = poster_ != nullptr ? poster_->look() : std::nullopt;
    if (!value || (taken_ && *taken_ == date_of(*value))) return std::nullopt;
    taken_ = date_of(*value);
    return value;
  }

 private:
  const genom::Poster<Value>* poster_;
  std::optional<Time> taken_;
};

class RobotPosters {
 public:
  struct Laser {
    std::string name;
    world::LaserDescription description;
    NewValues<posters::LaserReading> readings;
  };

  RobotPosters(const scenario::RobotScenario& scenario, const bridge::Robot& robot)
      : odometry_(robot.names(), "rflex.odometry"), position_(robot.names(), "pom.position") {
    constexpr std::string_view reading = ".reading";
    for (const scenario::BridgeRow& row : scenario.bridge)
      for (std::size_t i = 0; i < scenario.laser_names.size(); ++i)
        if (row.device == scenario.laser_names[i] + std::string(reading))
          lasers.push_back({scenario.laser_names[i], scenario.body.lasers[i], {robot.names(), row.poster}});
  }

  /// Those that a module reads.
  std::vector<Laser> lasers;

  std::optional<posters::LaserReading> scan(Laser& laser) {
    return laser.readings.take([](const posters::LaserReading& reading) { return reading.date; });
  }
  std::optional<posters::Odometry> odometry() {
    return odometry_.take([](const posters::Odometry& odometry) { return odometry.position.date; });
  }
  std::optional<posters::FusedPosition> position() {
    return position_.take([](const posters::FusedPosition& fused) { return fused.position.date; });
  }

 private:
  NewValues<posters::Odometry> odometry_;
  NewValues<posters::FusedPosition> position_;
};

}  // namespace waitpoint::tools
