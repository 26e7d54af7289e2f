// SPDX-License-Identifier: BSD-3-Clause
// The map that a robot is given, and the clearance of its cells. Independent of the robot's size, hence shared by all
// robots with the same map.
#pragma once

#include <cstdint>
#include <vector>

#include "core/large_pages.hpp"
#include "core/occupancy_grid.hpp"

namespace waitpoint::executive {

class KnownSpace {
 public:
  using Clearances = std::vector<std::uint16_t, LargePages<std::uint16_t>>;

  /// `is_known` false: cells without an obstacle are not known to be free.
  explicit KnownSpace(OccupancyGrid map, bool is_known = true) : map_(std::move(map)), is_known_(is_known) {}

  const OccupancyGrid& map() const { return map_; }
  bool is_known() const { return is_known_; }
  /// For each cell, row by row: the squared distance from its centre to the nearest obstacle, in half cells; 0 for
  /// occupied or unknown cells. Computed on first use: robots without goals need only the map.
  const Clearances& clearances() const {
    if (clearances_.empty()) find_clearances();
    return clearances_;
  }

 private:
  void find_clearances() const;

  OccupancyGrid map_;
  bool is_known_;
  mutable Clearances clearances_;
};

}  // namespace waitpoint::executive
