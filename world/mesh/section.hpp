// SPDX-License-Identifier: BSD-3-Clause
// What of a triangle in space is at one height, for beams; and what of it is between two heights, as seen from above,
// for bodies.
//
// A corner at the height of the cut itself counts as above it. So a triangle is cut in one segment or not at all, those
// that share a side end at the same point of it, to the last bit, and a surface without holes is cut in lines without
// gaps. A level triangle is never cut, its neighbours below are.
#pragma once

#include <optional>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// The segment in which the triangle is cut at that height; none for one that is not.
std::optional<Outline> cut(const Triangle& triangle, double height_m);

/// Of the part that has heights in the open interval (z_low_m, z_high_m), what it covers of the plane: at most three
/// triangles or segments, which are appended. A level triangle counts by its own height.
void cover(const Triangle& triangle, double z_low_m, double z_high_m, std::vector<Outline>& pieces);

}  // namespace waitpoint::world
