// SPDX-License-Identifier: BSD-3-Clause
// The serial line between a laser and its module: a scan is on it for as long as its bytes take, one after the other.
#pragma once

#include <optional>
#include <vector>

#include "modules/posters/laser.hpp"

namespace waitpoint::bridge {

class ScanLine {
 public:
  /// Each scan takes `transmission`, which may be 0.
  explicit ScanLine(Duration transmission) : transmission_(transmission) {}

  bool empty() const { return scans_.empty(); }
  bool takes_time() const { return transmission_ > Duration(); }
  /// Puts a scan on the line, behind those that are there.
  void send(Time now, const posters::LaserReading& scan);
  /// When the next one will have come through; nothing if the line is empty.
  std::optional<Time> next_arrival() const;
  /// Takes off the first scan if it has come through by `now`.
  bool take(Time now, posters::LaserReading& scan);

 private:
  struct OnTheWay {
    Time arrival;
    posters::LaserReading scan;
  };

  Duration transmission_;
  Time free_;  // from when on
  std::vector<OnTheWay> scans_;
};

}  // namespace waitpoint::bridge
