// SPDX-License-Identifier: BSD-3-Clause
// Meshes in Wavefront's OBJ: corners ("v x y z") and faces of them ("f 1 2 3", "f 1//4 2//4 3//4", "f -3 -2 -1").
//
// A face of more than three corners is taken as the fan of triangles about its first one. What only says how it looks
// (vn, vt, materials, groups, names) counts for nothing here; lines, points, curves and the like are left out and told.
#pragma once

#include <string>
#include <string_view>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// Reads the contents of an OBJ file; `file` is its name, for messages. One is one metre. Triangles without area are
/// left out, and told. BadInput, naming file and line, for what is no OBJ, coordinates that are no numbers or beyond
/// mesh_coordinate_max, a face of corners that are not there; for a file without faces, or of more than
/// triangle_count_max triangles.
TriangleMesh parse_obj(std::string_view contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
