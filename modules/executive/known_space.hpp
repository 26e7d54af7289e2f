// SPDX-License-Identifier: BSD-3-Clause
// A known map and how near each cell is to its obstacles: the same for all robots that are given the map, however large
// they are, and so shared by them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/occupancy_grid.hpp"

namespace waitpoint::executive {

class KnownSpace {
 public:
  explicit KnownSpace(OccupancyGrid map) : map_(std::move(map)) {}

  const OccupancyGrid& map() const { return map_; }
  /// Of each cell, row by row: the squared distance from its centre to the nearest obstacle, in half cells; 0 for cells
  /// that are occupied or unknown. Found when it is first asked for: robots without goals ask for the map alone.
  const std::vector<std::uint16_t>& clearances() const;

 private:
  OccupancyGrid map_;
  mutable std::vector<std::uint16_t> clearances_;
};

}  // namespace waitpoint::executive
