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
        lasers.push_back({robot.laser_names[i], row.poster, robot.body.lasers[i]});
  return lasers;
}

class RobotPosters {
 public:
  RobotPosters(const scenario::RobotScenario& scenario, const bridge::Robot& robot)
      : odometry_(robot.names(), "rflex.odometry"), position_(robot.names(), "pom.position") {
    for (const RecordedLaser& laser : recorded_lasers(scenario)) lasers_.emplace_back(robot.names(), laser.poster);
  }

  /// By recorded laser.
  std::vector<std::optional<posters::LaserReading>> scans() {
    std::vector<std::optional<posters::LaserReading>> scans;
    for (NewValues<posters::LaserReading>& laser : lasers_)
      scans.push_back(laser.take([](const posters::LaserReading& reading) { return reading.date; }));
    return scans;
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
  std::vector<NewValues<posters::LaserReading>> lasers_;
};

}  // namespace waitpoint::tools
