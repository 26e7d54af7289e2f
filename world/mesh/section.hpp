// SPDX-License-Identifier: BSD-3-Clause
// The section of a triangle in space at one height, for beams; and the projection of its part between two heights, for
// bodies.
//
// A corner exactly at the height of the cut counts as above it. So a triangle is cut in one segment or not at all, the
// segments of triangles that share a side end at the same point of it, to the last bit, and a surface without holes is
// cut in lines without gaps. A level triangle is never cut; its lower neighbours are.
#pragma once

#include <optional>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// The segment in which the triangle is cut at `height_m`; none if it is not cut.
std::optional<Outline> cut(const Triangle& triangle, double height_m);

/// Appends the projection onto the plane of the triangle's part in the open interval of heights (z_low_m, z_high_m): at
/// most three triangles or segments. A level triangle counts by its own height.
void cover(const Triangle& triangle, double z_low_m, double z_high_m, std::vector<Outline>& pieces);

}  // namespace waitpoint::world
