// SPDX-License-Identifier: BSD-3-Clause
// The distance of two outlines and its direction, exact up to rounding.
#pragma once

#include "world/planar/outline.hpp"

namespace waitpoint::world {

struct Separation {
  double distance_m = 0;  ///< negative if they overlap: minus the shortest translation that separates them
  Point normal;           ///< unit vector of that distance or translation, from the first to the second
};

/// The least distance between the points of two outlines. The distance of (b, a) may differ from that of (a, b) in the
/// last bits: callers that need the same bits must keep the order.
Separation separation(const Outline& a, const Outline& b);

}  // namespace waitpoint::world
