// SPDX-License-Identifier: BSD-3-Clause
// The state of a base's drive.
#pragma once

#include "world/world.hpp"

namespace waitpoint::world {

/// The velocity of the body and the steering angle (Ackermann; 0 is straight ahead).
struct BaseMotion {
  Velocity velocity;
  double steering_rad = 0;
};

}  // namespace waitpoint::world
