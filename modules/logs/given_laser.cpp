// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/given_laser.hpp"

namespace waitpoint::logs {

void apply(const GivenLaser& laser, SensorLog& log) {
  if (laser.mount) log.mount = *laser.mount;
  for (LoggedScan& scan : log.scans) {
    if (laser.range_max_m) scan.range_max_m = *laser.range_max_m;
    const std::size_t beams = scan.range_m.size();
    if (!laser.field_of_view_rad || beams == 0) continue;
    // A single beam is along the axis.
    scan.first_angle_rad = beams == 1 ? 0 : -*laser.field_of_view_rad / 2;
    if (beams > 1) scan.angle_step_rad = *laser.field_of_view_rad / static_cast<double>(beams - 1);
  }
}

}  // namespace waitpoint::logs
