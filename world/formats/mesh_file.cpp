// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/mesh_file.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/missing_part.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/obj.hpp"
#include "world/formats/stl.hpp"

namespace waitpoint::world {
namespace {

// The extension in lower case.
std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

TriangleMesh read(const std::string& file, LeftOut& left_out) {
  const std::string ending = ending_of(file);
  if (ending == ".stl") return parse_stl(file_contents(file, "an STL mesh", mesh_bytes_max), file, left_out);
  if (ending == ".obj") return parse_obj(file_contents(file, "an OBJ mesh", mesh_bytes_max), file, left_out);
  if (assimp_reads(ending)) return read_mesh_by_assimp(file_contents(file, "a mesh", tree_bytes_max), file, left_out);
  throw BadInput(
      file, std::string("expected a mesh in a file that ends in .stl or .obj") +
                (assimp_reads(".dae") ? std::string(", or that Assimp reads")
                                      : std::string("; others are not read by this program: ") + missing_part::meshes));
}

}  // namespace

bool reads_meshes_like(const std::string& file) {
  const std::string ending = ending_of(file);
  return ending == ".stl" || ending == ".obj" || assimp_reads(ending);
}

TriangleMesh read_mesh_file(const std::string& file, const MeshPlacement& placement, LeftOut& left_out) {
  TriangleMesh mesh = placed(read(file, left_out), placement.scale, placement.pose);
  const bool within = std::all_of(mesh.corners.begin(), mesh.corners.end(),
                                  [](const SpaceVector& corner) { return corner.is_within(coordinate_m_max); });
  if (!within)
    throw BadInput(file, "expected a mesh within 100 km of the world's origin, in metres: does it need a scale?");
  return mesh;
}

}  // namespace waitpoint::world
