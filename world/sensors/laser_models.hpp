// SPDX-License-Identifier: BSD-3-Clause
// Lasers that can be bought, by the figures of their data sheets and of their protocol.
//
//                    noise (1 sigma)           resolution, greatest range
//   LMS 200          5 mm to 8 m, 10 mm at 20  1, 10 or 100 mm a unit, 8191 units
//   LMS 291          10 mm to 20 m             the same
//
// Both turn 75 times a second and look each degree; half degrees take two interlaced turns, quarters four, and quarters
// only over 100 degrees. The light's diameter is the one that the maker gives for the LMS 1xx: 8 mm + 15 mrad.
#pragma once

#include <optional>
#include <string>

#include "world/sensor_description.hpp"

namespace waitpoint::world {

/// An LMS at 0.5 degrees over 180, in centimetres, on a line of 500 kbit/s.
LaserDescription lms_200();
LaserDescription lms_291();

/// Sets the turns that an LMS needs for its beams and its field of view. Says what such a device cannot do; then the
/// description is as it was.
std::optional<std::string> set_lms_mode(LaserDescription& laser);

/// The greatest range that an LMS has a number for, at that resolution.
double lms_range_max_m(double resolution_m);

}  // namespace waitpoint::world
