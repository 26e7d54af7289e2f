// SPDX-License-Identifier: BSD-3-Clause
// Segment maps: walls as lines of text, "x0 y0 x1 y1" in metres, with blanks or commas between the numbers; '#' starts
// a comment.
//
// A wall is a box about its segment, of the same length and a tenth of a millimetre thick. That is thin for sensors: a
// range is short by 0.05 mm over the cosine of its incidence, where a laser's resolution is 1 to 10 mm. And it is thick
// for computations: 50 times the gap at which bodies stop, 100 times FCL's tolerances (its narrow phase ignores boxes
// without thickness), and a wall exactly between two rows of cells is drawn into both, where one without thickness
// would be in none. Walls that share an end have no gap: both contain that point.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "world/description.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::world {

inline constexpr double wall_thickness_m = 1e-4;

/// The wall on the segment from `a` to `b`, which must differ.
Shape wall_between(Point a, Point b, double z_low_m, double z_high_m);

/// Reads the contents of a segment map; `file` is its name, for messages. The walls are named "segment 0", ...; those
/// shorter than a nanometre are left out. BadInput, naming file and line, for a line without four numbers, or with
/// numbers beyond coordinate_m_max; for a file without segments or with more than obstacle_count_max.
std::vector<Obstacle> parse_segments(std::string_view contents, const std::string& file, double height_m,
                                     LeftOut& left_out);

}  // namespace waitpoint::world
