// SPDX-License-Identifier: BSD-3-Clause
// Cells of a grid by their column, or their row.
#pragma once

#include <algorithm>
#include <cmath>

namespace waitpoint::matching {

/// The cell of a coordinate that is given in cells. Beyond half a thousand million, and for what is no number, that
/// cell: differences of two are integers, too.
inline int cell_of(double coordinate_cells) {
  constexpr double most = 5e8;
  return static_cast<int>(std::floor(std::min(std::max(-most, coordinate_cells), most)));
}

}  // namespace waitpoint::matching
