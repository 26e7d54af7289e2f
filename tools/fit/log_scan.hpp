// SPDX-License-Identifier: BSD-3-Clause
// A scan of a log as the modules get it: of more beams than their posters hold, every n-th, as in a replay.
#pragma once

#include <cstddef>

#include "modules/logs/sensor_log.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::tools {

/// Which beams of a scan are used: every n-th.
inline std::size_t beam_stride(std::size_t beams) {
  return beams == 0 ? 1 : (beams + world::Lasers::count_max - 1) / world::Lasers::count_max;
}

/// Overwrites all but date and number.
inline void take_scan(const logs::LoggedScan& scan, const Pose& mount, posters::Echoes& echoes) {
  const std::size_t every = beam_stride(scan.range_m.size());
  echoes.mount = mount;
  echoes.scan.first_angle_rad = scan.first_angle_rad;
  echoes.scan.angle_step_rad = scan.angle_step_rad * static_cast<double>(every);
  echoes.scan.range_max_m = scan.range_max_m;
  echoes.scan.range_m.clear();
  for (std::size_t i = 0; i < scan.range_m.size(); i += every) echoes.scan.range_m.push_back(scan.range_m[i]);
}

}  // namespace waitpoint::tools
