// SPDX-License-Identifier: BSD-3-Clause
// Mesh files: STL and OBJ with own readers, which are fuzzed; all other formats of Assimp (COLLADA, PLY, glTF, ...)
// with that library, in builds with it. The format is given by the extension of the file's name.
#pragma once

#include <string>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

/// The placement of a file's mesh in a world.
struct MeshPlacement {
  SpaceVector scale = {1, 1, 1};  ///< metres per unit of the file, along each of its axes
  SpacePose pose;
};

/// True if this program can read mesh files with that extension.
bool reads_meshes_like(const std::string& file);

/// Reads a mesh and places it, with warnings for parts left out. BadInput, one line that names the file (and the line,
/// in text formats), for an unreadable file, one of more than mesh_bytes_max, or a mesh that extends beyond
/// coordinate_m_max.
TriangleMesh read_mesh_file(const std::string& file, const MeshPlacement& placement, LeftOut& left_out);

/// The part with Assimp; assimp_reads() is always false in builds without it.
bool assimp_reads(const std::string& ending);
TriangleMesh read_mesh_by_assimp(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
