// SPDX-License-Identifier: BSD-3-Clause
// Octrees as written by OctoMap's own library.
#include "world/formats/octree.hpp"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/octomap.h>

#include <sstream>

#include "tests/world/formats/files.hpp"
#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

template <class Tree>
void fill(Tree& tree, std::uint64_t seed) {
  Draws draw(seed);
  for (int i = 0; i < 3000; ++i)
    tree.updateNode(octomap::point3d(static_cast<float>(draw(-2, 2)), static_cast<float>(draw(-2, 2)),
                                     static_cast<float>(draw(-1, 1))),
                    i % 3 != 0);
  // A wall, whose cells the tree merges into larger ones.
  for (int x = 0; x < 32; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 16; ++z)
        tree.updateNode(octomap::point3d(0.05f + 0.1f * static_cast<float>(x), 3.05f + 0.1f * static_cast<float>(y),
                                         0.05f + 0.1f * static_cast<float>(z)),
                        true);
  tree.updateInnerOccupancy();
  tree.prune();
}

bool has(const std::vector<Shape>& shapes, double x, double y, double z) {
  return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& s) {
    return std::fabs(x - s.pose.x) < 0.5 * s.length_m && std::fabs(y - s.pose.y) < 0.5 * s.width_m && s.z_low_m < z &&
           z < s.z_high_m;
  });
}

template <class Tree>
void expect_covers(const std::vector<Shape>& shapes, const Tree& tree) {
  double volume_m3 = 0, expected_m3 = 0;
  for (const Shape& s : shapes) volume_m3 += s.length_m * s.width_m * (s.z_high_m - s.z_low_m);
  std::size_t cells = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const bool occupied = tree.isNodeOccupied(*leaf);
    EXPECT_EQ(has(shapes, leaf.getX(), leaf.getY(), leaf.getZ()), occupied);
    if (!occupied) continue;
    ++cells;
    expected_m3 += leaf.getSize() * leaf.getSize() * leaf.getSize();
  }
  EXPECT_NEAR(volume_m3, expected_m3, 1e-9 * expected_m3);
  EXPECT_LT(shapes.size(), cells);
  EXPECT_GT(shapes.size(), 100u);
}

TEST(Octree, BinaryTreeCoversOccupiedSpace) {
  octomap::OcTree tree(0.1);
  fill(tree, 1);
  std::ostringstream out;
  tree.writeBinary(out);
  expect_covers(parse_octree(out.str(), "t.bt"), tree);
}

TEST(Octree, OccupancyTreeCoversOccupiedSpace) {
  octomap::OcTree tree(0.1);
  fill(tree, 2);
  std::ostringstream out;
  tree.write(out);
  expect_covers(parse_octree(out.str(), "t.ot"), tree);
}

TEST(Octree, ColourTreeCoversOccupiedSpace) {
  octomap::ColorOcTree tree(0.1);
  fill(tree, 3);
  std::ostringstream out;
  tree.write(out);
  expect_covers(parse_octree(out.str(), "t.ot"), tree);
}

TEST(Octree, IsPlaced) {
  const Folder folder;
  octomap::OcTree tree(0.5);
  tree.updateNode(octomap::point3d(1.2f, 0.2f, 0.2f), true);
  tree.updateNode(octomap::point3d(1.2f, 0.2f, 0.7f), true);
  tree.updateNode(octomap::point3d(1.2f, 0.2f, -3.0f), true);
  tree.writeBinary(folder.path("t.bt"));
  LeftOut left_out;
  const std::vector<Obstacle> boxes = read_octree(folder.path("t.bt"), "tree", {10, 0, 0.5 * exact::pi}, 0.5, left_out);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].name, "tree 0");
  EXPECT_NEAR(boxes[0].shape.pose.x, 9.75, 1e-12);
  EXPECT_NEAR(boxes[0].shape.pose.y, 1.25, 1e-12);
  EXPECT_EQ(boxes[0].shape.z_low_m, 0.5);
  EXPECT_EQ(boxes[0].shape.z_high_m, 1.5);
  ASSERT_EQ(left_out.warnings().size(), 1u);
  EXPECT_NE(left_out.warnings()[0].find("an obstacle below the floor is left out"), std::string::npos);
}

TEST(Octree, RefusesWhatIsNone) {
  const auto parse = [](const std::string& contents) { return [contents] { parse_octree(contents, "t.bt"); }; };
  EXPECT_TRUE(complains(parse("hello"), "t.bt: ", "expected an octree"));
  const std::string header = "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.1\n";
  EXPECT_TRUE(complains(parse(header), "t.bt: ", "ends with 'data'"));
  EXPECT_TRUE(complains(parse(header + "data\n"), "t.bt: ", "found the file's end"));
  EXPECT_TRUE(complains(parse(header + "res nan\ndata\n"), "t.bt: ", "expected 'res'"));
  EXPECT_TRUE(complains(parse(header + "id Tree\ndata\n"), "t.bt: ", "found 'Tree'"));
  EXPECT_TRUE(complains(parse(header + "colour 3\ndata\n"), "t.bt: ", "found 'colour'"));
  EXPECT_TRUE(complains(parse(header + "data\n" + std::string(2, '\0')), "t.bt: ", "expected occupied cells"));
  EXPECT_TRUE(complains(parse(header + "data\n" + std::string(99, '\xFF')), "t.bt: ", "at most 16 levels"));
  EXPECT_TRUE(complains(parse(header + "res 1000\ndata\n\x02" + std::string(1, '\0')), "t.bt: ", "within 100 km"));
}

}  // namespace
}  // namespace waitpoint::world
