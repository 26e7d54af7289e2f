// SPDX-License-Identifier: BSD-3-Clause
// Meshes in STL, of text ("solid", "facet", "vertex" and so on) or of bytes (80 of any kind, a count, 50 a triangle).
//
// Which of them a file is, its length tells: files of bytes may begin with "solid", too.
#pragma once

#include <string>
#include <string_view>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// Reads the contents of an STL file; `file` is its name, for messages. A file has no unit: one is one metre. Triangles
/// without area are left out, and told. BadInput for what is no STL, is cut off, has coordinates that are no numbers or
/// beyond mesh_coordinate_max, no triangle, or more than triangle_count_max.
TriangleMesh parse_stl(std::string_view contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
