// SPDX-License-Identifier: BSD-3-Clause
// OctoMap's octrees: .bt, with cells that are occupied, free or unknown, and .ot, with the log odds of occupancy per
// cell (ColorOcTree is read, too).
//
// A file is a text header up to the word "data", then the tree in preorder: in .bt a node has two bits for each of its
// eight children, in .ot its value and one bit for each child.
//
// Occupied cells become upright boxes. Cells of one size are merged into columns first, then columns along x, then the
// resulting walls along y, without a change of the volume. Free and unknown cells are open to beams and to bodies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::world {

/// Reads the contents of such a file; `file` is its name, for messages. The boxes are in the tree's frame. In .ot a
/// cell is occupied at even odds or better. BadInput for another format, a truncated file, more than 16 levels, an
/// invalid resolution, cells beyond coordinate_m_max, no occupied cell, more than octree_cell_count_max, or more than
/// obstacle_count_max boxes.
std::vector<Shape> parse_octree(std::string_view contents, const std::string& file);

/// The boxes as obstacles "NAME 0", "NAME 1", ..., with the tree's frame at `pose` and `height_m`. Boxes below the
/// floor are left out with a warning.
std::vector<Obstacle> read_octree(const std::string& file, const std::string& name, const Pose& pose, double height_m,
                                  LeftOut& left_out);

}  // namespace waitpoint::world
