// SPDX-License-Identifier: BSD-3-Clause
// A command that a robot's software gave to its body, as a value.
#pragma once

#include "world/world.hpp"

namespace waitpoint::bridge {

struct BodyCommand {
  world::BodyId body{};
  world::Velocity velocity;
};

}  // namespace waitpoint::bridge
