// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/scan_line.hpp"

#include <algorithm>

namespace waitpoint::bridge {

void ScanLine::send(Time now, const posters::LaserReading& scan) {
  free_ = std::max(free_, now) + transmission_;
  scans_.push_back({free_, scan});
}

std::optional<Time> ScanLine::next_arrival() const {
  if (scans_.empty()) return std::nullopt;
  return scans_.front().arrival;
}

bool ScanLine::take(Time now, posters::LaserReading& scan) {
  if (scans_.empty() || scans_.front().arrival > now) return false;
  scan = scans_.front().scan;
  scans_.erase(scans_.begin());
  return true;
}

}  // namespace waitpoint::bridge
