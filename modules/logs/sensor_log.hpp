// SPDX-License-Identifier: BSD-3-Clause
// A log of a robot's sensors as values: the scans of one laser and the odometry of the base, as recorded.
//
// Stamps are those of the log, in nanoseconds since its own origin, in any order and not necessarily distinct:
// playing_order.hpp makes dates of them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::logs {

struct LoggedScan {
  Time stamp;
  std::uint64_t place = 0;  ///< its position among all records of the log
  double first_angle_rad = 0, angle_step_rad = 0;
  double range_max_m = 0;  ///< readings from here on are no echoes
  std::vector<float> range_m = {};
  std::optional<Pose> odometry = {};  ///< recorded with the scan
  Time received = {};                 ///< by the recorder's clock, which orders the records before `place`; or unknown
};

struct LoggedOdometry {
  Time stamp;
  std::uint64_t place = 0;  ///< its position among all records of the log
  Pose pose;
  Time received = {};  ///< as that of a scan
};

struct SensorLog {
  std::string file, format;
  std::string laser;  ///< the record type or topic of the scans
  Pose mount;         ///< the laser's pose on the robot
  std::vector<LoggedScan> scans;
  std::vector<LoggedOdometry> odometry;
  std::map<std::string, std::uint64_t> left_out;  ///< number of other records, by type or topic
};

/// The choice from a log that has several of a kind; empty: the only one, or the format's default.
struct LogChoice {
  std::string scan = {};      ///< record type or topic
  std::string odometry = {};  ///< topic
  std::string robot = {};     ///< CARMEN: the host of the records

  /// Where each is said, or would be, for messages: an option, or a key of a scenario.
  std::string scan_place = "--scan", odometry_place = "--odometry", robot_place = "--robot";
};

}  // namespace waitpoint::logs
