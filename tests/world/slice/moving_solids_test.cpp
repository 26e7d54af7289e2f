// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/moving_solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

// Every solid is in the tree once, under rectangles that contain it.
void expect_sound(const MovingSolids& solids) {
  std::vector<int> times(solids.size());
  const std::span<const TreeNode> nodes = solids.nodes();
  for (std::size_t number = 0; number < nodes.size(); ++number) {
    for (std::size_t i = 0; i < EightBounds::width; ++i) {
      const std::int32_t child = nodes[number].child[i];
      if (child == TreeNode::none) continue;
      const EightBounds& b = nodes[number].bounds;
      const Bounds around = {{b.low_x[i], b.low_y[i]}, {b.high_x[i], b.high_y[i]}};
      if (child < 0) {
        ++times[static_cast<std::size_t>(~child)];
        EXPECT_TRUE(around.contains(bounds_of(solids.outline(static_cast<std::size_t>(~child))).grown(1e-7)));
        continue;
      }
      ASSERT_GT(static_cast<std::size_t>(child), number);
      const TreeNode& below = nodes[static_cast<std::size_t>(child)];
      for (std::size_t k = 0; k < EightBounds::width && below.child[k] != TreeNode::none; ++k) {
        EXPECT_TRUE(around.contains(
            {{below.bounds.low_x[k], below.bounds.low_y[k]}, {below.bounds.high_x[k], below.bounds.high_y[k]}}));
      }
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(solids.size()));
}

TEST(MovingSolids, AreUnderTheirTreeWhereverTheyGo) {
  for (const int count : {0, 1, 2, 8, 9, 64, 65, 100, 513, 1000}) {
    Draws draw(static_cast<std::uint64_t>(count) + 1);
    std::vector<Shape> shapes;
    for (int i = 0; i < count; ++i) shapes.push_back(random_shape(draw, 20, 0.8));
    MovingSolids solids(shapes);
    expect_sound(solids);
    for (int round = 0; round < 12; ++round) {
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        shapes[i].pose.x += draw(-3, 3);
        shapes[i].pose.y += draw(-3, 3);
        solids.place(i, outline_of(shapes[i]));
      }
      expect_sound(solids);
    }
  }
}

TEST(MovingSolids, NearSolidsHaveOverlappingBounds) {
  Draws draw(2);
  std::vector<Shape> shapes;
  for (int i = 0; i < 700; ++i) shapes.push_back(random_shape(draw, 20, 0.8));
  MovingSolids solids(shapes);
  std::vector<std::uint32_t> found;
  for (int k = 0; k < 2000; ++k) {
    const std::size_t moved = draw.below(shapes.size());
    shapes[moved].pose.x = draw(-20, 20);
    solids.place(moved, outline_of(shapes[moved]));
    const Point low = {draw(-22, 20), draw(-22, 20)};
    const Bounds bounds = {low, {low.x + draw(0, 3), low.y + draw(0, 3)}};
    solids.near(bounds, found);
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
      const Bounds own = bounds_of(outline_of(shapes[i]));
      const bool is_found = std::binary_search(found.begin(), found.end(), i);
      ASSERT_TRUE(is_found || !own.overlaps(bounds)) << k;
      ASSERT_TRUE(!is_found || own.grown(1e-4).overlaps(bounds)) << k;
    }
  }
}

// All are listed once, those of one node consecutively.
TEST(MovingSolids, AreListedNeighboursSideBySide) {
  Draws draw(4);
  std::vector<Shape> shapes;
  for (int i = 0; i < 1000; ++i) shapes.push_back(cylinder({draw(0, 64), draw(0, 64)}, 0.2));
  const MovingSolids solids(shapes);
  std::vector<std::uint32_t> places = {7};
  solids.list_by_leaves(places);
  double way_m = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    way_m += length(shapes[places[i]].pose.position() - shapes[places[i - 1]].pose.position());
  EXPECT_LT(way_m / 1000, 6) << "drawn at random they are 33 m from each other";
  std::sort(places.begin(), places.end());
  ASSERT_EQ(places.size(), 1000u);
  for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(places[i], i);
  MovingSolids(std::span<const Shape>()).list_by_leaves(places);
  EXPECT_TRUE(places.empty());
}

// After thorough mixing the tree is rebuilt: boxes of eight are not much larger than the space of eight solids.
TEST(MovingSolids, NeighboursStayTogetherInTheTree) {
  Draws draw(3);
  std::vector<Shape> shapes;
  for (int i = 0; i < 4096; ++i) shapes.push_back(cylinder({draw(0, 64), draw(0, 64)}, 0.2));
  MovingSolids solids(shapes);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      shapes[i].pose = {draw(0, 64), draw(0, 64), 0};
      solids.place(i, outline_of(shapes[i]));
    }
    double half_perimeters_m = 0;
    const std::span<const TreeNode> nodes = solids.nodes();
    std::size_t leaves = 0;
    for (const TreeNode& node : nodes) {
      for (std::size_t i = 0; i < EightBounds::width && node.child[i] >= 0 && node.child[i] != TreeNode::none; ++i) {
        if (nodes[static_cast<std::size_t>(node.child[i])].child[0] >= 0) continue;
        half_perimeters_m += static_cast<double>((node.bounds.high_x[i] - node.bounds.low_x[i]) +
                                                 (node.bounds.high_y[i] - node.bounds.low_y[i]));
        ++leaves;
      }
    }
    EXPECT_EQ(leaves, 512u);
    EXPECT_LT(half_perimeters_m / 512, 2 * 2.83 * 1.5) << "eight of them have a square of 2.83 m";
  }
}

}  // namespace
}  // namespace waitpoint::world
