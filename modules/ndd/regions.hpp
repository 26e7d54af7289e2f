// SPDX-License-Identifier: BSD-3-Clause
// Gaps and regions of a nearness diagram.
//
// A gap is between two neighbouring sectors whose distances differ by the robot's width or more, or of which only one
// has an obstacle. A region is a run of sectors between two consecutive gaps, at least one of which ascends into the
// region: an opening behind an obstacle's edge. A diagram without gaps and obstacles is one region; one without gaps
// but with obstacles (a room without a door) has none.
#pragma once

#include "core/fields.hpp"
#include "modules/ndd/diagram.hpp"

namespace waitpoint::ndd {

struct Region {
  int first = 0;                ///< its rightmost sector
  int sectors = 0;              ///< number of sectors, counter-clockwise from the first
  bool opens_at_right = false;  ///< the gap at its right edge ascends into it
  bool opens_at_left = false;

  int last() const { return first + sectors - 1; }
  double width_rad() const { return sectors * sector_width_rad; }
  /// The direction of its middle, in (-pi, pi].
  double middle_rad() const;
  bool holds(int sector) const { return static_cast<int>(Diagram::wrap(sector - first)) < sectors; }
};

using Regions = Bounded<Region, sector_count>;

/// Finds the regions, ordered by their first sectors. `robot_width_m` is the gap threshold.
void find_regions(const Diagram& diagram, double robot_width_m, Regions& regions);

}  // namespace waitpoint::ndd
