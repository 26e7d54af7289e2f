// SPDX-License-Identifier: BSD-3-Clause
// A bumper: panels about a body, each pressed by what touches it from the directions that it faces.
#pragma once

#include <cstdint>

#include "world/planar/separation.hpp"
#include "world/sensor_description.hpp"

namespace waitpoint::world {

/// The bit of the panel that something at `separation` from a body of that heading presses; 0 if it is not near enough.
std::uint32_t pressed_panel(const BumperDescription& bumper, double heading_rad, const Separation& separation);

}  // namespace waitpoint::world
