// SPDX-License-Identifier: BSD-3-Clause
// The records of a log in the order in which they are played, each with its virtual time.
//
//   in the log's order: a stamp over a second before the greatest so far is of a clock that was set back: that record
//                       and all after it are moved on, to follow at once
//   sorted by stamp:    lesser disorder comes from records written late
//   dated:              the stamp, from that of the first record on; a microsecond after the record before it if it is
//                       not later than that
//
// Every scan has the robot's odometry at its date: the pose recorded with it, or else that between the reports before
// and after it.
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
  std::uint64_t set_back = 0;   ///< times that the clock was set back
};

/// BadInput if stamps are more than a day apart.
PlayingOrder playing_order(const SensorLog& log);

}  // namespace waitpoint::logs
