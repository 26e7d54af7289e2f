// SPDX-License-Identifier: BSD-3-Clause
// The serial line between a device and its module: readings occupy it for their transmission time, one after another.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/time.hpp"

namespace waitpoint::bridge {

template <class Reading>
class ReadingLine {
 public:
  /// `transmission` is the time per reading; may be 0.
  explicit ReadingLine(Duration transmission) : transmission_(transmission) {}

  bool empty() const { return readings_.empty(); }
  bool takes_time() const { return transmission_ > Duration(); }
  /// Appends a reading to the line's queue.
  void send(Time now, const Reading& reading) {
    free_ = std::max(free_, now) + transmission_;
    readings_.push_back({free_, reading});
  }
  /// Arrival time of the next reading; nothing if the line is empty.
  std::optional<Time> next_arrival() const {
    if (readings_.empty()) return std::nullopt;
    return readings_.front().arrival;
  }
  /// Removes the first reading if it has arrived by `now`; false if it has not.
  bool take(Time now, Reading& reading) {
    if (readings_.empty() || readings_.front().arrival > now) return false;
    reading = readings_.front().reading;
    readings_.erase(readings_.begin());
    return true;
  }

 private:
  struct OnTheWay {
    Time arrival;
    Reading reading;
  };

  Duration transmission_;
  Time free_;  // from this time on
  std::vector<OnTheWay> readings_;
};

}  // namespace waitpoint::bridge
