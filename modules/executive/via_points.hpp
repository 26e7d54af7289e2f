// SPDX-License-Identifier: BSD-3-Clause
// Reduces a path of cells to a few via points, each in sight of the one before, for reactive navigation.
//
//   1. anchors    the ends of the path, and a point before and after every narrow passage: doors are entered along the
//                 path, not at an angle
//   2. pulling    between anchors the path is pulled straight; a straight leg keeps the least clearance of the piece
//                 of path that it replaces (or the preferred one), and at least the full clearance: where there is
//                 less, it follows the cells
//   3. spacing    long legs are divided
#pragma once

#include <vector>

#include "modules/executive/free_space.hpp"

namespace waitpoint::executive {

/// Replaces `via` by cells of `path`, and points between them on long legs; first and last are those of `path`.
void pull_via_cells(const FreeSpace& space, const std::vector<CellIndex>& path, std::vector<CellIndex>& via);

}  // namespace waitpoint::executive
