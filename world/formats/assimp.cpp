// SPDX-License-Identifier: BSD-3-Clause
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/error.hpp"
#include "core/printable_line.hpp"
#include "world/formats/assimp_files.hpp"
#include "world/formats/mesh_builder.hpp"
#include "world/formats/mesh_file.hpp"

namespace waitpoint::world {

bool assimp_reads(const std::string& ending) {
  return !ending.empty() && Assimp::Importer().IsExtensionSupported(ending);
}

TriangleMesh read_mesh_by_assimp(const std::string& contents, const std::string& file, LeftOut& left_out) {
  Assimp::Importer importer;
  // COLLADA's up axis is ignored, as in other readers of robots' files.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  auto* const files = new AssimpFiles(file);
  importer.SetIOHandler(files);  // which owns it from now on
  const std::string ending = file.substr(file.rfind('.') + 1);
  const aiScene* scene = importer.ReadFileFromMemory(
      contents.data(), contents.size(), aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType,
      ending.c_str());
  files->require_none_refused();
  if (scene == nullptr)
    throw BadInput(file, printable_line("expected a mesh, Assimp says: " + std::string(importer.GetErrorString())));
  MeshBuilder builder(file, left_out);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(builder.corner_count());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& v = part.mVertices[i];
      builder.add_corner({static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}, 0);
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices == 3)
        builder.add_triangle(first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2], 0);
    }
  }
  return builder.mesh();
}

}  // namespace waitpoint::world
