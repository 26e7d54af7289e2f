// SPDX-License-Identifier: BSD-3-Clause
// OctoMap's trees of cells: .bt, where a cell is occupied, free or unknown, and .ot, where it has the logarithm of its
// odds to be occupied (a tree of colours is read, too).
//
// The file is a header of text, up to the word "data", then the tree from its root down, each node followed by its
// children: in .bt a node is two bits for each of its eight children, in .ot its value and a bit for each child.
//
// Occupied cells become upright boxes. Of cells of one size those above each other are merged first, then such columns
// along x, then such walls along y: they cover exactly what the cells cover. Free and unknown cells are open to beams
// and to bodies alike.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::world {

/// Reads the contents of such a file; `file` is its name, for messages. The boxes are in the tree's frame. In .ot a
/// cell is occupied that is so at even odds or better. BadInput for what is no such file, is cut off, has a tree of
/// more than 16 levels, a resolution that is none, cells beyond coordinate_m_max, no occupied cell, more than
/// octree_cell_count_max, or more than obstacle_count_max boxes.
std::vector<Shape> parse_octree(std::string_view contents, const std::string& file);

/// The boxes as obstacles "NAME 0", "NAME 1", ..., the tree's frame being at `pose`, so high. Those that end below the
/// floor are left out, and told.
std::vector<Obstacle> read_octree(const std::string& file, const std::string& name, const Pose& pose, double height_m,
                                  LeftOut& left_out);

}  // namespace waitpoint::world
