// SPDX-License-Identifier: BSD-3-Clause
// New values of a robot's posters, for recordings.
#pragma once

#include <optional>

#include "modules/bridge/robot.hpp"
#include "modules/posters/position.hpp"
#include "tools/record/recorded_readings.hpp"

namespace waitpoint::tools {

class RobotPosters {
 public:
  RobotPosters(const scenario::RobotScenario& scenario, const bridge::Robot& robot)
      : odometry_(robot.names(), "rflex.odometry"),
        position_(robot.names(), "pom.position"),
        readings_(scenario, robot.names()) {}

  NewReadings readings() { return readings_.take_all(); }
  template <class S>
  NewReadingsOf<S> readings_of() {
    return readings_.take<S>();
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
  ReadingPosters readings_;
};

}  // namespace waitpoint::tools
