// SPDX-License-Identifier: BSD-3-Clause
// The command of a drive for one step.
#pragma once

#include "world/world.hpp"

namespace waitpoint::world {

/// The velocity that a drive is to reach by the end of a step, and the limits of its forces.
struct DriveAim {
  Velocity velocity;
  double force_n = 0, side_force_n = 0, torque_nm = 0, climb_force_n = 0;
};

}  // namespace waitpoint::world
