// SPDX-License-Identifier: BSD-3-Clause
// The map that a robot has seen: an occupancy grid on the cells of its known map, from laser scans by ray tracing.
//
// Each cell has an evidence, a small integer that a scan raises if an echo ends in the cell and lowers if a beam passes
// through it; it is bounded, so that moved obstacles are gone after some scans. Beams stop short of the cell of
// their echo, and no beam of a scan passes through a cell in which another one ends: thin obstacles are not worn away
// by the beams beside them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/executive/tiled_grid.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::executive {

class SeenMap {
 public:
  /// On the cells of `map`, which is borrowed. Of longer ranges, the first `range_m_max` are free.
  SeenMap(const OccupancyGrid& map, double range_m_max);

  /// Adds a scan made with the device at `device`, in the map frame.
  void add(const Pose& device, const posters::LaserReading& scan);
  /// Forgets all cells.
  void forget();

  bool occupied(CellIndex c) const { return cells_(c.x, c.y).evidence >= occupied_from; }
  /// True if a beam has passed through the cell or ended in it.
  bool seen(CellIndex c) const { return cells_(c.x, c.y).evidence != unseen; }
  /// Cells that have been occupied at some time; each once.
  const std::vector<CellIndex>& ever_occupied() const { return ever_occupied_; }

 private:
  using Evidence = std::int8_t;
  static constexpr Evidence unseen = -128, least = -4, most = 8, occupied_from = 3, hit = 3, miss = -1;
  struct Seen {
    std::uint32_t echo_of = 0;  // the number of the last scan with an echo in the cell
    Evidence evidence = unseen;
    bool is_listed = false;  // in ever_occupied_
  };

  void mark_echoes(const Pose& device, const posters::LaserReading& scan);
  void clear_beam(Point from, Point end, double short_m);
  void raise_echoes();

  const OccupancyGrid& map_;
  double range_m_max_;
  TiledGrid<Seen> cells_;
  std::uint32_t scans_ = 0;
  std::vector<CellIndex> echoes_;  // of the present scan
  std::vector<CellIndex> ever_occupied_;
};

}  // namespace waitpoint::executive
