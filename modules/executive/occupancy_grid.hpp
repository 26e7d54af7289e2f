// SPDX-License-Identifier: BSD-3-Clause
// The known map as a grid of square cells.
//
//   row `height - 1`   ...          cell (column, row) covers [column, column + 1) x [row, row + 1) cells of
//   row 1              ...          resolution_m, in the frame of `origin`: the outer corner of cell (0, 0),
//   row 0   (0,0) (1,0) ...         in the map frame; it may be turned.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"

namespace waitpoint::executive {

enum class CellState : std::uint8_t {
  free,
  occupied,
  unknown,  ///< never observed: nothing is known to stand there, but no way is planned through it
};

struct Cell {
  std::int32_t column = 0, row = 0;
  friend constexpr bool operator==(Cell, Cell) = default;
};

struct OccupancyGrid {
  std::int32_t width = 0, height = 0;
  double resolution_m = 0.05;
  Pose origin;
  std::vector<CellState> cells;  ///< row by row, from row 0

  bool holds(Cell c) const { return c.column >= 0 && c.column < width && c.row >= 0 && c.row < height; }
  /// A cell outside the grid is a bug.
  CellState at(Cell c) const {
    WAITPOINT_CHECK(holds(c), "a cell outside the map");
    return cells[static_cast<std::size_t>(c.row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(c.column)];
  }
  /// The cell that a point of the map frame lies in; it may be outside.
  Cell cell_at(Point p) const {
    const Point q = between(origin, {p.x, p.y, 0}).position();
    return {index_of(q.x / resolution_m), index_of(q.y / resolution_m)};
  }
  /// The centre of a cell in the map frame.
  Point centre(Cell c) const {
    return transform(origin, {(c.column + 0.5) * resolution_m, (c.row + 0.5) * resolution_m});
  }

 private:
  static std::int32_t index_of(double cells) {
    constexpr double limit = 1e9;
    if (!(cells > -limit)) return -1000000000;
    return static_cast<std::int32_t>(std::floor(cells < limit ? cells : limit));
  }
};

}  // namespace waitpoint::executive
