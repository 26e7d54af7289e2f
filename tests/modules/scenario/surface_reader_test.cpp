// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/surface_reader.hpp"

#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

class SurfaceReader : public ::testing::Test {
 protected:
  Scenario read(std::string_view text) const { return read_scenario(folder_.write("s.yaml", text), {}); }
  TemporaryFolder folder_;
};

// An upright triangle of 2 m by 1 m, along x.
constexpr std::string_view triangle_stl =
    "solid s\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 0 1\nendloop\nendsolid\n";
// Cells of 10 cm: one is occupied, from the origin to (0.1, 0.1, 0.1), and two below it.
std::string octree() {
  std::string tree = "# Octomap OcTree binary file\nid OcTree\nsize 16\nres 0.1\ndata\n";
  const auto node = [&](int child, int state) {
    const int bits = state << 2 * child;
    tree += static_cast<char>(bits & 255);
    tree += static_cast<char>(bits >> 8);
  };
  node(7, 3);
  for (int level = 0; level < 14; ++level) node(0, 3);
  node(0, 2);
  return tree;
}

TEST_F(SurfaceReader, ReadsMeshesAndOctreesAmongShapes) {
  folder_.write("parts/wall.stl", triangle_stl);
  folder_.write("yard.bt", octree());
  const Scenario scenario = read(changed("  shapes:\n",
                                         "  shapes:\n"
                                         "    - {name: crane, mesh: parts/wall.stl, at_m: [10, 20, 0.5], heading_deg: "
                                         "90, scale: [2, 1, 1], known: false}\n"
                                         "    - {octomap: yard.bt, at_m: [5, 5], known: false}\n"));
  ASSERT_EQ(scenario.meshes.size(), 1u);
  EXPECT_EQ(scenario.meshes[0].name, "crane");
  EXPECT_FALSE(scenario.meshes[0].known);
  EXPECT_NEAR(scenario.meshes[0].mesh->corners[1].y, 24, 1e-12);
  EXPECT_EQ(scenario.meshes[0].mesh->corners[2].z, 1.5);
  EXPECT_EQ(scenario.world_without_map().meshes.size(), 1u);
  ASSERT_EQ(scenario.shapes.size(), 4u);
  EXPECT_EQ(scenario.shapes_written.size(), 4u);
  EXPECT_EQ(scenario.shapes[0].name, "shape 2 0");
  EXPECT_FALSE(scenario.shapes[0].known);
  EXPECT_NEAR(scenario.shapes[0].shape.pose.x, 5.05, 1e-12);
  EXPECT_NEAR(scenario.shapes[0].shape.z_high_m, 0.1, 1e-12);
  EXPECT_EQ(scenario.shapes[2].name, "shape 4") << "its place in the list";
}

TEST_F(SurfaceReader, ReportsBadMeshesAndOctrees) {
  folder_.write("wall.stl", triangle_stl);
  folder_.write("bad.stl", "solid s\nvertx\n");
  // Empty, or the actual message.
  const auto says = [&](const std::string& shape, const std::string& what) {
    const std::string line =
        message_of<BadInput>([&] { read(changed("  shapes:\n", "  shapes:\n    - " + shape + "\n")); });
    return line.find(what) != std::string::npos ? "" : "'" + line + "'";
  };
  EXPECT_EQ(says("{mesh: none.stl}", "none.stl: expected an STL mesh, found no file"), "");
  EXPECT_EQ(says("{mesh: bad.stl}", "bad.stl:2: expected STL"), "");
  EXPECT_EQ(says("{mesh: wall.stl, scale: 0}", "expected scale to be a number from 0.000001 to 1000000, found '0'"),
            "");
  EXPECT_EQ(says("{mesh: wall.stl, scale: 1e6}", "wall.stl: expected a mesh within 100 km"), "");
  EXPECT_EQ(says("{mesh: wall.stl, mass_kg: 3}", "mass_kg"), "");
  EXPECT_EQ(says("{mesh: wall.stl, octomap: tree.bt}", "octomap"), "");
  EXPECT_EQ(says("{octomap: wall.stl}", "wall.stl: expected an octree"), "");
  EXPECT_EQ(says("{name: desk, mesh: wall.stl}", "there are two shapes called 'desk'"), "");
}

}  // namespace
}  // namespace waitpoint::scenario
