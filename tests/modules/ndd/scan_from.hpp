// SPDX-License-Identifier: BSD-3-Clause
// Scans of shapes without noise: 361 beams over 180 degrees, from a laser 0.1 m ahead of the robot's centre.
#pragma once

#include "tests/modules/ndd/closed_loop.hpp"

namespace waitpoint::ndd {

inline posters::Echoes scan_from(const test::Shapes& shapes, const Pose& robot, Time date) {
  posters::Echoes echoes;
  echoes.mount = {0.1, 0, 0};
  echoes.scan.date = date;
  echoes.scan.first_angle_rad = -exact::pi / 2;
  echoes.scan.angle_step_rad = exact::pi / 360;
  echoes.scan.range_max_m = 32;
  const Pose device = compose(robot, echoes.mount);
  for (int i = 0; i <= 360; ++i) {
    const double angle = device.heading + echoes.scan.first_angle_rad + i * echoes.scan.angle_step_rad;
    echoes.scan.range_m.push_back(static_cast<float>(shapes.range(device.position(), angle, 32)));
  }
  return echoes;
}

}  // namespace waitpoint::ndd
