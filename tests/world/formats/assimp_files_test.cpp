// SPDX-License-Identifier: BSD-3-Clause
// The files beside a mesh that Assimp reads.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "core/confinement.hpp"
#include "tests/world/formats/files.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/mesh_file.hpp"

namespace waitpoint::world {
namespace {

namespace fs = std::filesystem;

/// Nine floats: the corners of a triangle.
std::string triangle_bytes() {
  std::string bytes;
  for (const float number : {0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 3.F, 0.F})
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(std::bit_cast<std::uint32_t>(number) >> 8 * i & 255);
  return bytes;
}

/// A glTF of one triangle, whose corners are in the buffer.
std::string gltf(const std::string& uri, std::size_t size = 36) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [2,3,0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": ")" +
         uri + R"(", "byteLength": )" + std::to_string(size) + "}]}\n";
}

class AssimpFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!assimp_reads(".gltf")) GTEST_SKIP() << "without Assimp's glTF";
    fs::create_directories(folder_.path("own"));
  }

  TriangleMesh read(const std::string& file) {
    LeftOut left_out;
    return read_mesh_file(file, {}, left_out);
  }

  Folder folder_;
};

TEST_F(AssimpFilesTest, AreSoughtBesideTheMesh) {
  const std::string file = folder_.write("own/m.gltf", gltf("m.bin"));
  EXPECT_TRUE(complains([&] { read(file); }, file, "Assimp says")) << "without its buffer";
  folder_.write("own/m.bin", triangle_bytes());
  const TriangleMesh mesh = read(file);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangle(0).corners[2].y, 3);
  folder_.write("outside.bin", triangle_bytes());
  EXPECT_EQ(read(folder_.write("own/up.gltf", gltf("../outside.bin"))).triangles.size(), 1u);
}

TEST_F(AssimpFilesTest, AreConfined) {
  const std::string outside = folder_.write("outside.bin", triangle_bytes());
  const std::string up = folder_.write("own/up.gltf", gltf("../outside.bin"));
  const std::string absolute = folder_.write("own/absolute.gltf", gltf(outside));
  fs::create_symlink(outside, folder_.path("own/link.bin"));
  const std::string linked = folder_.write("own/linked.gltf", gltf("link.bin"));
  const std::string none = folder_.write("own/none.gltf", gltf("../none.bin"));
  folder_.write("own/m.bin", triangle_bytes());
  const std::string inside = folder_.write("own/m.gltf", gltf("m.bin"));
  const Confinement confinement(std::vector{fs::path(folder_.path("own"))});
  EXPECT_TRUE(complains([&] { read(up); }, outside, "outside of the folders"));
  EXPECT_TRUE(complains([&] { read(absolute); }, outside, "outside of the folders"));
  EXPECT_TRUE(complains([&] { read(linked); }, folder_.path("own/link.bin"), "outside of the folders"));
  EXPECT_TRUE(complains([&] { read(none); }, folder_.path("none.bin"), "outside of the folders"));
  EXPECT_EQ(read(inside).triangles.size(), 1u);
}

TEST_F(AssimpFilesTest, AreRegular) {
  const std::string file = folder_.write("own/m.gltf", gltf("pipe.bin"));
  ASSERT_EQ(mkfifo(folder_.path("own/pipe.bin").c_str(), 0600), 0);
  EXPECT_TRUE(complains([&] { read(file); }, folder_.path("own/pipe.bin"), "found no regular file"));
  const std::string absolute = folder_.write("own/absolute.gltf", gltf(folder_.path("own/pipe.bin")));
  EXPECT_TRUE(complains([&] { read(absolute); }, folder_.path("own/pipe.bin"), "found no regular file"));
}

TEST_F(AssimpFilesTest, AreOfLimitedSize) {
  const std::string file = folder_.write("own/m.gltf", gltf("m.bin", tree_bytes_max + 1));
  folder_.write("own/m.bin", "");
  fs::resize_file(folder_.path("own/m.bin"), tree_bytes_max + 1);
  EXPECT_TRUE(complains([&] { read(file); }, folder_.path("own/m.bin"), "of at most 16 MiB"));
}

TEST_F(AssimpFilesTest, AreOfLimitedSizeTogether) {
  const std::size_t size = tree_bytes_max / 2 + 1;
  std::string text = gltf("m.bin", size);
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"("POSITION": 0)", R"("POSITION": 0, "NORMAL": 1)");
  replace(R"("accessors": [)",
          R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}, )");
  replace(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min")",
          R"({"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3", "min")");
  replace(R"("bufferViews": [)", R"("bufferViews": [{"buffer": 1, "byteLength": 36}, )");
  replace(R"("buffers": [)", R"("buffers": [{"uri": "n.bin", "byteLength": )" + std::to_string(size) + "}, ");
  for (const char* name : {"own/m.bin", "own/n.bin"}) {
    folder_.write(name, triangle_bytes());
    fs::resize_file(folder_.path(name), size);
  }
  const std::string file = folder_.write("own/m.gltf", text);
  EXPECT_TRUE(complains([&] { read(file); }, folder_.path("own/"), "at most 16 MiB in all files"));
}

TEST_F(AssimpFilesTest, MaterialFilesAreOptional) {
  LeftOut left_out;
  const std::string text = "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(read_mesh_by_assimp(text, folder_.path("own/m.obj"), left_out).triangles.size(), 1u);
}

}  // namespace
}  // namespace waitpoint::world
