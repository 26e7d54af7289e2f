// SPDX-License-Identifier: BSD-3-Clause
// New values of a robot's posters, for recordings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/bridge/robot.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"
#include "tools/record/recorded_readings.hpp"

namespace waitpoint::tools {

/// A laser that a module reads.
struct RecordedLaser {
  std::string name, poster;
  world::LaserDescription description;
};

inline std::vector<RecordedLaser> recorded_lasers(const scenario::RobotScenario& robot) {
  std::vector<RecordedLaser> lasers;
  for (const scenario::BridgeRow& row : robot.bridge)
    for (std::size_t i = 0; i < robot.laser_names.size(); ++i)
      if (row.device == robot.laser_names[i] + std::string(".reading"))
        lasers.push_back({robot.laser_names[i], row.poster, robot.body.sensors<world::Lasers>()[i]});
  return lasers;
}

class RobotPosters {
 public:
  RobotPosters(const scenario::RobotScenario& scenario, const bridge::Robot& robot)
      : odometry_(robot.names(), "rflex.odometry"),
        position_(robot.names(), "pom.position"),
        readings_(scenario, robot.names()) {
    for (const RecordedLaser& laser : recorded_lasers(scenario)) lasers_.emplace_back(robot.names(), laser.poster);
  }

  /// By recorded laser.
  std::vector<std::optional<posters::LaserReading>> scans() {
    std::vector<std::optional<posters::LaserReading>> scans;
    for (NewValues<posters::LaserReading>& laser : lasers_)
      scans.push_back(laser.take([](const posters::LaserReading& reading) { return reading.date; }));
    return scans;
  }
  NewReadings readings() { return readings_.take(); }
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
  std::vector<NewValues<posters::LaserReading>> lasers_;
};

}  // namespace waitpoint::tools
