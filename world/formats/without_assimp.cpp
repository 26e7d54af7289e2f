// SPDX-License-Identifier: BSD-3-Clause
// In place of assimp.cpp in builds without Assimp.
#include "core/error.hpp"
#include "world/formats/mesh_file.hpp"

namespace waitpoint::world {

bool assimp_reads(const std::string&) { return false; }

TriangleMesh read_mesh_by_assimp(const std::string&, const std::string& file, LeftOut&) {
  throw BadInput(file, "expected an STL or OBJ mesh: other kinds need Assimp, which is not in this program");
}

}  // namespace waitpoint::world
