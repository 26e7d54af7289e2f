// SPDX-License-Identifier: BSD-3-Clause
// A map of square cells: free, occupied or unknown.
//
// Column x counts along the grid's own x axis, row y along its y axis, both from the grid's origin, which is the outer
// corner of cell (0, 0); the grid's frame may be rotated. Unknown cells are closed to a planner and open to a beam.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"

namespace waitpoint {

enum class Cell : std::uint8_t { free, occupied, unknown };

/// A cell's indices in a grid.
struct CellIndex {
  int x = 0, y = 0;

  friend constexpr auto operator<=>(CellIndex, CellIndex) = default;
};

class OccupancyGrid {
 public:
  /// The greatest number of cells of a grid.
  static constexpr std::int64_t cells_max = std::int64_t{1} << 28;

  OccupancyGrid() = default;
  /// Width and height in cells, at least 1 each, at most cells_max in all; resolution (edge of a cell) positive.
  OccupancyGrid(int width, int height, double resolution_m, const Pose& origin, Cell fill = Cell::unknown);

  int width() const { return width_; }
  int height() const { return height_; }
  double resolution_m() const { return resolution_m_; }
  const Pose& origin() const { return origin_; }

  bool contains(CellIndex c) const { return c.x >= 0 && c.y >= 0 && c.x < width_ && c.y < height_; }
  Cell operator[](CellIndex c) const { return cells_[offset(c)]; }
  Cell& operator[](CellIndex c) { return cells_[offset(c)]; }
  /// All cells, row by row.
  std::span<const Cell> cells() const { return cells_; }

  /// The centre of a cell, in the outer frame.
  Point centre(CellIndex c) const;
  /// The cell that contains a point of the outer frame; none if the point is outside the grid.
  std::optional<CellIndex> cell_at(Point p) const;

 private:
  std::size_t offset(CellIndex c) const {
    WAITPOINT_CHECK(contains(c), "a cell outside its grid");
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(c.x);
  }

  int width_ = 0, height_ = 0;
  double resolution_m_ = 1;
  Pose origin_;
  std::vector<Cell> cells_;
};

}  // namespace waitpoint
