// SPDX-License-Identifier: BSD-3-Clause
// A known map and the clearance of its cells. Independent of the robot's size, hence shared by all robots with the same
// map.
#pragma once

#include <cstdint>
#include <vector>

#include "core/large_pages.hpp"
#include "core/occupancy_grid.hpp"

namespace waitpoint::executive {

class KnownSpace {
 public:
  using Clearances = std::vector<std::uint16_t, LargePages<std::uint16_t>>;

  explicit KnownSpace(OccupancyGrid map) : map_(std::move(map)) {}

  const OccupancyGrid& map() const { return map_; }
  /// For each cell, row by row: the squared distance from its centre to the nearest obstacle, in half cells; 0 for
  /// occupied or unknown cells. Computed on first use: robots without goals need only the map.
  const Clearances& clearances() const;

 private:
  OccupancyGrid map_;
  mutable Clearances clearances_;
};

}  // namespace waitpoint::executive
