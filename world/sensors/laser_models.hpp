// SPDX-License-Identifier: BSD-3-Clause
// Commercial lasers, by the figures of their data sheets and of their protocol.
//
//                    noise (1 sigma)           resolution, greatest range
//   LMS 200          5 mm to 8 m, 10 mm at 20  1, 10 or 100 mm a unit, 8191 units
//   LMS 291          10 mm to 20 m             the same
//
// Both turn 75 times a second and measure at each degree; half degrees take two interlaced turns, quarters four, and
// quarters only over at most 100 degrees. The spot's diameter is the maker's figure for the LMS 1xx: 8 mm + 15 mrad.
#pragma once

#include <optional>
#include <string>

#include "world/sensors/types/lasers.hpp"

namespace waitpoint::world {

/// An LMS at 0.5 degrees over 180, in centimetres, on a line of 500 kbit/s.
LaserDescription lms_200();
LaserDescription lms_291();

/// Sets the interlaced turns that an LMS needs for its beams and field of view. Returns an error message, and leaves
/// the description unchanged, for a mode that such a device does not have.
std::optional<std::string> set_lms_mode(LaserDescription& laser);

/// The greatest range that an LMS can encode at that resolution.
double lms_range_max_m(double resolution_m);

}  // namespace waitpoint::world
