// SPDX-License-Identifier: BSD-3-Clause
// From the cells of a way to few via points that a reactive navigation can follow by sight.
//
//   1. anchors    the ends of the way, and a point before and one behind every narrow passage: doors are entered along
//                 the way, not at a slant
//   2. pulling    between anchors the way is pulled straight; a straight leg never comes nearer to obstacles than the
//                 piece of the way it replaces (or than the preferred clearance), nor than the full clearance: where
//                 there is less, it follows the cells
//   3. spacing    long legs are divided
#pragma once

#include <vector>

#include "modules/executive/free_space.hpp"

namespace waitpoint::executive {

/// Replaces `via` by cells of `path` (with points between them on long legs); the first is `path`'s first, the last its
/// last.
void pull_via_cells(const FreeSpace& space, const std::vector<CellIndex>& path, std::vector<CellIndex>& via);

}  // namespace waitpoint::executive
