// SPDX-License-Identifier: BSD-3-Clause
// How far two outlines are apart, and in which direction: exact but for rounding.
#pragma once

#include "world/planar/outline.hpp"

namespace waitpoint::world {

struct Separation {
  double distance_m = 0;  ///< negative where they overlap: minus the least way to slide them apart
  Point normal;           ///< unit vector from the first to the second along that way
};

/// The least distance between the points of two outlines. The distance of (b, a) may differ from that of (a, b) in the
/// last bits: who needs the same bits asks in the same order.
Separation separation(const Outline& a, const Outline& b);

}  // namespace waitpoint::world
