// SPDX-License-Identifier: BSD-3-Clause
// Meshes in STL, text ("solid", "facet", "vertex" and so on) or binary (80 bytes of header, a count, 50 bytes per
// triangle).
//
// A file is binary if its length agrees with its count: binary files may begin with "solid", too.
#pragma once

#include <string>
#include <string_view>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// Reads the contents of an STL file; `file` is its name, for messages. STL has no unit: it is taken as a metre.
/// Triangles without area are left out with a warning. BadInput for another format, a truncated file, coordinates that
/// are not numbers or are beyond mesh_coordinate_max, no triangle, or more than triangle_count_max.
TriangleMesh parse_stl(std::string_view contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
