// SPDX-License-Identifier: BSD-3-Clause
// The exact distance from every cell's centre to the nearest occupied cell, as a square area.
//
// Computed in integers, as squared distances in half cells. A centre dx, dy cells from an occupied cell's centre is at
// (2|dx| - 1)^2 + (2|dy| - 1)^2 from its square; a term is 0 where dx or dy is 0. The two passes are those of
// Felzenszwalb and Huttenlocher, "Distance transforms of sampled functions", 2012: along the columns, then the lower
// envelope of parabolas along each row. On the lattice of half cells a square contributes three sites to a row: its
// left edge, its centre line and its right edge; plain parabolas then give the distance to the square.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace waitpoint::executive {

/// The cap on squared distances, about 127 cells; also the value where no cell is occupied.
inline constexpr std::uint16_t square_half_cells_max = 65535;

class DistanceTransform {
 public:
  /// `occupied` has width * height bytes, row by row, not 0 where occupied; `squares` receives as many squared
  /// distances in half cells, capped. Working memory is kept for the next call.
  void run(std::span<const std::uint8_t> occupied, std::int32_t width, std::int32_t height,
           std::span<std::uint16_t> squares);

 private:
  static void along_columns(std::span<const std::uint8_t> occupied, std::size_t width, std::span<std::uint16_t> steps);
  void along_row(std::int32_t width, std::span<const std::int64_t> column_squares, std::span<std::uint16_t> squares);

  std::vector<std::int64_t> row_;    // squared half-cell distances along the columns, for one row
  std::vector<std::int32_t> sites_;  // of the envelope, in half cells
  std::vector<std::int64_t> heights_, starts_;
};

}  // namespace waitpoint::executive
