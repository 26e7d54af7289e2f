// SPDX-License-Identifier: BSD-3-Clause
// Mesh files: accepted, rejected, and read equally by Assimp.
#include "world/formats/mesh_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/world/formats/files.hpp"
#include "tests/world/meshes.hpp"
#include "world/formats/obj.hpp"
#include "world/formats/stl.hpp"

namespace waitpoint::world {
namespace {

const std::string one_facet =
    "solid s\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 +2.5e0 0\n  endloop\n "
    "endfacet\nendsolid s\n";

void put(std::string& bytes, std::uint32_t number) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> 8 * i & 255);
}

std::string stl_bytes(const TriangleMesh& mesh, std::uint32_t count_told) {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");
  put(bytes, count_told);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) put(bytes, 0);
    for (const SpaceVector& corner : mesh.triangle(i).corners)
      for (const double c : {corner.x, corner.y, corner.z})
        put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(c)));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# a mesh\nmtllib m.mtl\no thing\n";
  for (const SpaceVector& c : mesh.corners)
    text += "v " + std::to_string(c.x) + " " + std::to_string(c.y) + " " + std::to_string(c.z) + "\n";
  for (const auto& t : mesh.triangles)
    text += "f " + std::to_string(t[0] + 1) + "//1 " + std::to_string(t[1] + 1) + "//1 " + std::to_string(t[2] + 1) +
            "//1\n";
  return text;
}

// Sums that do not depend on the order of triangles.
SpaceVector moments(const TriangleMesh& mesh) {
  SpaceVector sum;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const SpaceVector& c : mesh.triangle(i).corners)
      sum = sum + SpaceVector{c.x * c.x, c.y + c.x * c.z, c.z * c.z * c.y};
  return sum;
}

TriangleMesh read_stl(const std::string& contents) {
  LeftOut left_out;
  return parse_stl(contents, "m.stl", left_out);
}
TriangleMesh read_obj(const std::string& contents) {
  LeftOut left_out;
  return parse_obj(contents, "m.obj", left_out);
}

TEST(Stl, ReadsText) {
  const TriangleMesh mesh = read_stl(one_facet);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangle(0).corners[2].y, 2.5);
  EXPECT_EQ(read_stl("SOLID\n" + one_facet.substr(8)).triangles.size(), 1u);
}

TEST(Stl, ReadsBinaryThatBeginsWithSolid) {
  const TriangleMesh ball = lumpy_ball(*std::make_unique<Draws>(1), 2, 3);
  const TriangleMesh mesh = read_stl(stl_bytes(ball, 128));
  ASSERT_EQ(mesh.triangles.size(), 128u);
  EXPECT_EQ(mesh.triangle(5).corners[1].x, static_cast<double>(static_cast<float>(ball.triangle(5).corners[1].x)));
}

TEST(Stl, RefusesWhatIsNone) {
  EXPECT_TRUE(complains([] { read_stl("hello"); }, "m.stl: ", "expected STL: text that begins with 'solid'"));
  const TriangleMesh ball = lumpy_ball(*std::make_unique<Draws>(1), 1, 3);
  std::string cut_off = stl_bytes(ball, 33);
  cut_off[0] = 'x';
  EXPECT_TRUE(complains([&] { read_stl(cut_off); }, "m.stl: ", "found 1684 bytes for 33 triangles"));
  cut_off = stl_bytes(ball, 4'000'000'000u);
  cut_off[0] = 'x';
  EXPECT_TRUE(complains([&] { read_stl(cut_off); }, "m.stl: ", "bytes for 4000000000 triangles"));
  EXPECT_TRUE(complains([] { read_stl("solid s\nendsolid s\n"); }, "m.stl: ", "expected triangles that have an area"));
  TriangleMesh nan = ball;
  nan.corners[3].y = std::nan("");
  EXPECT_TRUE(complains([&] { read_stl(stl_bytes(nan, 32)); }, "m.stl: ", "to be numbers up to 1e9"));
  const auto with = [](const char* what, const char* instead) {
    std::string text = one_facet;
    return text.replace(text.find(what), std::string(what).size(), instead);
  };
  EXPECT_TRUE(complains([&] { read_stl(with("vertex 1 0 0", "vertex 1 nan 0")); }, "m.stl:5: ", "found 'nan'"));
  EXPECT_TRUE(complains([&] { read_stl(with("vertex 1 0 0", "vertex 1 0")); }, "m.stl:5: ", "expected 'vertex x y z'"));
  EXPECT_TRUE(complains([&] { read_stl(with("vertex 1 0 0", "vertex 1e10 0 0")); }, "m.stl:5: ", "up to 1e9"));
  EXPECT_TRUE(complains([&] { read_stl(with("vertex 1 0 0", "")); }, "m.stl:7: ", "expected three vertices"));
  EXPECT_TRUE(complains([&] { read_stl(with("endloop", "endlop")); }, "m.stl:7: ", "found 'endlop'"));
  EXPECT_TRUE(complains([&] { read_stl(one_facet.substr(0, 60)); }, "m.stl:5: ", "expected 'endloop'"));
}

TEST(Obj, IsRead) {
  const TriangleMesh mesh =
      read_obj("v 0 0 0\nv 2 0 0 1.0\nv 2 2 0\nv 0 2 1\nvn 0 0 1\nf 1/1/1 2/2/1 3 4\r\nf -4 -3 -1\n");
  ASSERT_EQ(mesh.triangles.size(), 3u) << "a face of four corners is two triangles";
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(mesh.triangles[2], (std::array<std::uint32_t, 3>{0, 1, 3}));
}

TEST(Obj, RefusesWhatIsNone) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\n";
  EXPECT_TRUE(
      complains([&] { read_obj(corners + "f 1 2 4\n"); }, "m.obj:4: ", "one of the 3 corners before, found '4'"));
  EXPECT_TRUE(complains([&] { read_obj(corners + "f 1 2 0\n"); }, "m.obj:4: ", "found '0'"));
  EXPECT_TRUE(complains([&] { read_obj(corners + "f -4 2 1\n"); }, "m.obj:4: ", "found '-4'"));
  EXPECT_TRUE(complains([&] { read_obj(corners + "f 1 2\n"); }, "m.obj:4: ", "expected three corners"));
  EXPECT_TRUE(complains([&] { read_obj(corners); }, "m.obj: ", "expected triangles"));
  EXPECT_TRUE(complains([&] { read_obj("v 0 inf 0\n"); }, "m.obj:1: ", "expected 'v x y z', found 'inf'"));
  EXPECT_TRUE(complains([&] { read_obj("hello there\n"); }, "m.obj:1: ", "expected OBJ: 'v', 'f' and so on"));
}

TEST(MeshFile, TellsWhatItLeavesOut) {
  LeftOut left_out;
  const TriangleMesh mesh =
      parse_obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\nf 1 2 4\nf 1 1 4\n", "m.obj", left_out);
  EXPECT_EQ(mesh.triangles.size(), 1u);
  const std::vector<std::string> expected = {"m.obj:5: 'l' is left out",
                                             "m.obj:6: a triangle without area is left out (2 times)"};
  EXPECT_EQ(left_out.warnings(), expected);
}

TEST(MeshFile, IsScaledAndPlaced) {
  const Folder folder;
  const std::string file = folder.write("M.STL", one_facet);
  LeftOut left_out;
  const TriangleMesh mesh =
      read_mesh_file(file, {{0.5, 2, 1}, space_pose({10, 20, 3}, 0, 0, 0.5 * exact::pi)}, left_out);
  EXPECT_NEAR(mesh.corners[1].y, 20.5, 1e-12);
  EXPECT_NEAR(mesh.corners[2].x, 5, 1e-12);
  EXPECT_EQ(mesh.corners[2].z, 3);
  EXPECT_TRUE(complains([&] { read_mesh_file(file, {{1e6, 1, 1}, {}}, left_out); }, file, "within 100 km"));
}

TEST(MeshFile, RefusesWhatItCannotRead) {
  const Folder folder;
  LeftOut left_out;
  EXPECT_TRUE(complains([&] { read_mesh_file("none.stl", {}, left_out); }, "none.stl: ", "found no file"));
  const std::string file = folder.write("mesh.doc", one_facet);
  EXPECT_TRUE(complains([&] { read_mesh_file(file, {}, left_out); }, file, "ends in .stl or .obj"));
  EXPECT_FALSE(reads_meshes_like(file));
  EXPECT_TRUE(reads_meshes_like("a.b/C.Obj"));
}

TEST(MeshFile, AssimpReadsTheSameStlAndObj) {
  if (!assimp_reads(".stl")) GTEST_SKIP() << "without Assimp";
  Draws draw(1);
  const TriangleMesh ball = lumpy_ball(draw, 3, 3);
  LeftOut left_out;
  const std::string bytes = "binary " + stl_bytes(ball, static_cast<std::uint32_t>(ball.triangles.size())).substr(7);
  const SpaceVector ours = moments(read_stl(bytes)), theirs = moments(read_mesh_by_assimp(bytes, "m.stl", left_out));
  EXPECT_NEAR(ours.x, theirs.x, 1e-9);
  EXPECT_NEAR(ours.y, theirs.y, 1e-9);
  EXPECT_NEAR(ours.z, theirs.z, 1e-9);
  const std::string text = obj_text(ball);
  const SpaceVector ours_of_text = moments(read_obj(text)),
                    theirs_of_text = moments(read_mesh_by_assimp(text, "m.obj", left_out));
  EXPECT_NEAR(ours_of_text.x, theirs_of_text.x, 1e-2) << "floats";
  EXPECT_NEAR(ours_of_text.z, theirs_of_text.z, 1e-2);
}

TEST(MeshFile, OtherKindsAreAssimps) {
  if (!assimp_reads(".ply")) GTEST_SKIP() << "without Assimp";
  const Folder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "1\nproperty list uchar int vertex_indices\nend_header\n";
  LeftOut left_out;
  const std::string file = folder.write("m.ply", header + "0 0 0\n2 0 0\n2 2 0\n0 2 1\n4 0 1 2 3\n");
  EXPECT_EQ(read_mesh_file(file, {}, left_out).triangles.size(), 2u);
  const std::string bad = folder.write("bad.ply", "hello\n");
  EXPECT_TRUE(complains([&] { read_mesh_file(bad, {}, left_out); }, bad, "Assimp says"));
}

}  // namespace
}  // namespace waitpoint::world
