// SPDX-License-Identifier: BSD-3-Clause
// Invariants of the tree: every solid is in it once, within the rectangles above it.
#include "world/slice/tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

Bounds rectangle(const EightBounds& bounds, std::size_t i) {
  return {{bounds.low_x[i], bounds.low_y[i]}, {bounds.high_x[i], bounds.high_y[i]}};
}

struct Found {
  std::vector<int> times;
  int levels = 0, children = 0, nodes = 0;
};

void visit(const Tree& tree, std::span<const Bounds> solids, std::int32_t number, std::vector<Bounds>& above,
           Found& found) {
  const TreeNode& node = tree.nodes()[static_cast<std::size_t>(number)];
  ++found.nodes;
  found.levels = std::max(found.levels, static_cast<int>(above.size()) + 1);
  for (std::size_t i = 0; i < EightBounds::width; ++i) {
    above.push_back(rectangle(node.bounds, i));
    if (above.back().low.x > 1e29) {
      EXPECT_EQ(node.child[i], TreeNode::none) << "nothing is nowhere";
    } else if (node.child[i] >= 0) {
      ++found.children;
      EXPECT_GT(node.child[i], number);
      visit(tree, solids, node.child[i], above, found);
    } else {
      ++found.children;
      const auto solid = static_cast<std::size_t>(~node.child[i]);
      ++found.times[solid];
      const Bounds& b = solids[solid];
      for (const Bounds& around : above)
        EXPECT_TRUE(around.contains(Bounds{b.low - tree.middle(), b.high - tree.middle()}.grown(1e-7)));
    }
    above.pop_back();
  }
}

Found visit(const Tree& tree, std::span<const Bounds> solids) {
  Found found;
  found.times.resize(solids.size());
  std::vector<Bounds> above;
  visit(tree, solids, 0, above, found);
  return found;
}

void expect_sound(std::span<const Bounds> solids) {
  const Tree tree(solids);
  const Found found = visit(tree, solids);
  EXPECT_EQ(std::count(found.times.begin(), found.times.end(), 1), static_cast<std::ptrdiff_t>(solids.size()));
  EXPECT_EQ(found.levels, tree.depth());
}

TEST(Tree, HoldsEverySolidOnceWithinAllRectanglesAboveIt) {
  for (const double offset_m : {0.0, -3e3, 5e6}) {
    for (const int count : {1, 2, 7, 8, 9, 64, 65, 3000}) {
      std::vector<Bounds> solids;
      for (const Shape& shape : random_shapes(static_cast<std::uint64_t>(count), count, 50)) {
        const Bounds b = bounds_of(outline_of(shape));
        solids.push_back({b.low + Point{offset_m, 1.1 * offset_m}, b.high + Point{offset_m, 1.1 * offset_m}});
      }
      expect_sound(solids);
    }
  }
}

TEST(Tree, EndsHoweverSolidsLie) {
  const Bounds unit = {{1, 1}, {2, 2}};
  expect_sound(std::vector<Bounds>(5000, unit));
  std::vector<Bounds> nested, halving;
  for (int i = 0; i < 1000; ++i) nested.push_back(unit.grown(0.01 * i));
  for (int i = 0; i < 1000; ++i) halving.push_back({{0, 0}, {std::ldexp(1.0, -i), std::ldexp(1.0, -i)}});
  expect_sound(nested);
  expect_sound(halving);
}

TEST(Tree, IsFullAndFlatWhereSolidsAreSpreadEvenly) {
  std::vector<Bounds> solids;
  for (int i = 0; i < 4096; ++i) solids.push_back(Bounds{{i % 64 * 1.0, i / 64 * 1.0}, {i % 64 + 0.5, i / 64 + 0.5}});
  const Tree tree(solids);
  const Found found = visit(tree, solids);
  EXPECT_EQ(found.levels, 4);
  EXPECT_EQ(found.nodes, 1 + 8 + 64 + 512);
}

TEST(Tree, NoSolidsGiveAnEmptyTree) { EXPECT_TRUE(Tree({}).nodes().empty()); }

TEST(Tree, NumbersByNodesAreThoseOfTheSameSolidsInTheOrderOfTheNodes) {
  std::vector<Bounds> solids;
  for (const Shape& shape : random_shapes(7, 500, 40)) solids.push_back(bounds_of(outline_of(shape)));
  const Tree tree(solids);
  Tree numbered = tree;
  const std::vector<std::uint32_t> before = numbered.number_by_nodes();
  ASSERT_EQ(before.size(), solids.size());
  std::int32_t next = 0;
  for (std::size_t node = 0; node < tree.nodes().size(); ++node) {
    for (std::size_t i = 0; i < EightBounds::width; ++i) {
      const std::int32_t child = numbered.nodes()[node].child[i];
      if (child >= 0) {
        EXPECT_EQ(child, tree.nodes()[node].child[i]);
        continue;
      }
      EXPECT_EQ(~child, next++);
      EXPECT_EQ(before[static_cast<std::size_t>(~child)], static_cast<std::uint32_t>(~tree.nodes()[node].child[i]));
    }
  }
}

}  // namespace
}  // namespace waitpoint::world
