// SPDX-License-Identifier: BSD-3-Clause
// The records of a log in the order in which they are played, each with its virtual time.
//
//   in the log's order: dates grow by the differences of the stamps; where the clock was set, back by over a second or
//                       on by over a day, the next record follows at once
//   sorted by date:     lesser disorder comes from records written late
//   distinct:           a record at the same instant as the one before is a microsecond after it
//
// Every scan has the robot's odometry at its date: the pose recorded with it, or else that between the reports before
// and after it. A report of the same date as a scan is left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

struct Played {
  Time date;
  Pose odometry;
  std::optional<std::size_t> scan;  ///< its index in the log
};

struct PlayingOrder {
  std::vector<Played> records;  ///< their dates increase
  std::uint64_t late = 0;       ///< records with a stamp before that of one written earlier
  std::uint64_t equal = 0;      ///< records moved on by microseconds, since they are not after the one before
  std::uint64_t clock_set = 0;  ///< times that the clock was set
};

/// BadInput if the log is longer than a day, or its odometry than 10 000 km.
PlayingOrder playing_order(const SensorLog& log);

}  // namespace waitpoint::logs
