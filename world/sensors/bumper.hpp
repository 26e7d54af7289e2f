// SPDX-License-Identifier: BSD-3-Clause
// A bumper: panels about a body, each pressed by contacts from its sector of directions.
#pragma once

#include <cstdint>

#include "world/planar/separation.hpp"
#include "world/sensor_description.hpp"

namespace waitpoint::world {

/// The bit of the panel pressed by an outline at `separation` from a body of that heading; 0 if it is too far away.
std::uint32_t pressed_panel(const BumperDescription& bumper, double heading_rad, const Separation& separation);

}  // namespace waitpoint::world
