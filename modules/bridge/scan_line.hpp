// SPDX-License-Identifier: BSD-3-Clause
// The serial line between a laser and its module: scans occupy it for their transmission time, one after another.
#pragma once

#include <optional>
#include <vector>

#include "modules/posters/laser.hpp"

namespace waitpoint::bridge {

class ScanLine {
 public:
  /// `transmission` is the time per scan; may be 0.
  explicit ScanLine(Duration transmission) : transmission_(transmission) {}

  bool empty() const { return scans_.empty(); }
  bool takes_time() const { return transmission_ > Duration(); }
  /// Appends a scan to the line's queue.
  void send(Time now, const posters::LaserReading& scan);
  /// Arrival time of the next scan; nothing if the line is empty.
  std::optional<Time> next_arrival() const;
  /// Removes the first scan if it has arrived by `now`; false if it has not.
  bool take(Time now, posters::LaserReading& scan);

 private:
  struct OnTheWay {
    Time arrival;
    posters::LaserReading scan;
  };

  Duration transmission_;
  Time free_;  // from this time on
  std::vector<OnTheWay> scans_;
};

}  // namespace waitpoint::bridge
