// SPDX-License-Identifier: BSD-3-Clause
// Meshes in files: STL and OBJ by readers of this project's own, which bad files cannot harm; all other kinds that
// Assimp reads (COLLADA, PLY, glTF, ...) by that library, where the program was built with it. The ending of a file's
// name tells its kind.
#pragma once

#include <string>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// How a mesh of a file is made to stand in a world.
struct MeshPlacement {
  SpaceVector scale = {1, 1, 1};  ///< metres to one of the file's, along each of its axes
  SpacePose pose;
};

/// Whether meshes of files with such a name can be read by this program.
bool reads_meshes_like(const std::string& file);

/// Reads a mesh and places it. What is left out is told. BadInput, one line that names the file, and the line where
/// there are lines, for what cannot be read, a file of more than mesh_bytes_max, or a mesh that reaches beyond
/// coordinate_m_max.
TriangleMesh read_mesh_file(const std::string& file, const MeshPlacement& placement, LeftOut& left_out);

/// Assimp's part of it: false from the first where the program was built without it.
bool assimp_reads(const std::string& ending);
TriangleMesh read_mesh_by_assimp(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
