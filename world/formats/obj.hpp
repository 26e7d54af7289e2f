// SPDX-License-Identifier: BSD-3-Clause
// Meshes in Wavefront's OBJ: corners ("v x y z") and faces of them ("f 1 2 3", "f 1//4 2//4 3//4", "f -3 -2 -1").
//
// A face of more than three corners is a fan of triangles about its first corner. Appearance (vn, vt, materials,
// groups, names) is ignored; lines, points, curves and the like are left out with a warning.
#pragma once

#include <string>
#include <string_view>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// Reads the contents of an OBJ file; `file` is its name, for messages. The unit is a metre. Triangles without area are
/// left out with a warning. BadInput, naming file and line, for malformed text, coordinates that are not numbers or are
/// beyond mesh_coordinate_max, a face with undefined corners; for a file without faces, or with more than
/// triangle_count_max triangles.
TriangleMesh parse_obj(std::string_view contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
