// SPDX-License-Identifier: BSD-3-Clause
// The exact distance from every cell's centre to the nearest occupied cell, as a square area.
//
// Computed in integers, as squared distances in half cells. A centre dx, dy cells from an occupied cell's centre is at
// (2|dx| - 1)^2 + (2|dy| - 1)^2 from its square; a term is 0 where dx or dy is 0. The two passes are those of
// Felzenszwalb and Huttenlocher, "Distance transforms of sampled functions", 2012: along the columns, then the lower
// envelope of parabolas along each row. On the lattice of half cells a square contributes three sites to a row: its
// left edge, its centre line and its right edge; plain parabolas then give the distance to the square. A row is divided
// where so many columns without an obstacle near the row follow one another that both sides are beyond the cap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/occupancy_grid.hpp"

namespace waitpoint::executive {

/// The cap on squared distances, about 127 cells; also the value where no cell is occupied.
inline constexpr std::uint16_t square_half_cells_max = 65535;

class DistanceTransform {
 public:
  /// `cells` has width * height cells, row by row; `squares` receives as many squared distances in half cells, capped.
  /// Working memory is kept for the next call.
  void run(std::span<const Cell> cells, std::int32_t width, std::int32_t height, std::span<std::uint16_t> squares);

 private:
  static void along_columns(std::span<const Cell> cells, std::size_t width, std::span<std::uint16_t> steps);
  void divide(std::span<std::uint16_t> row);
  void along_row(std::span<std::uint16_t> part);

  std::vector<std::int64_t> row_;    // squared half-cell distances along the columns, for a part of a row
  std::vector<std::int32_t> sites_;  // of the envelope, in half cells
  std::vector<std::int64_t> heights_, starts_;
};

}  // namespace waitpoint::executive
