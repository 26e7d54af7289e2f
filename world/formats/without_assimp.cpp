// SPDX-License-Identifier: BSD-3-Clause
// In place of assimp.cpp in builds without Assimp.
#include "core/error.hpp"
#include "core/missing_part.hpp"
#include "world/formats/mesh_file.hpp"

namespace waitpoint::world {

bool assimp_reads(const std::string&) { return false; }

TriangleMesh read_mesh_by_assimp(const std::string&, const std::string& file, LeftOut&) {
  throw BadInput(file, std::string("expected an STL or OBJ mesh; other kinds are not read by this program: ") +
                           missing_part::meshes);
}

}  // namespace waitpoint::world
