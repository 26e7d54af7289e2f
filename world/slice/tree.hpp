// SPDX-License-Identifier: BSD-3-Clause
// A bounding-volume hierarchy, eight children per node, over fixed solids.
//
// Its rectangles are floats relative to the middle of all solids, with a margin: they only cull. A binary tree is built
// first, top down, with the sweep that minimises perimeter times count; it is then collapsed into nodes of eight such
// that the sum of the perimeters of all nodes is least.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/large_pages.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {

/// Eight rectangles, one per vector lane.
struct alignas(32) EightBounds {
  static constexpr int width = 8;
  float low_x[width], low_y[width], high_x[width], high_y[width];

  /// Rectangles beyond the reach of every view.
  static EightBounds nowhere();
  /// Sets one to `bounds` relative to `middle`, grown by `margin_m`, which must exceed the rounding to float.
  void set(int at, const Bounds& bounds, Point middle, double margin_m);
};

struct TreeNode {
  /// An unused lane; its rectangle is nowhere().
  static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();

  EightBounds bounds;
  /// Per rectangle: the index of another node, or ~number of a solid. Unused lanes are the last ones.
  std::array<std::int32_t, EightBounds::width> child;

  static TreeNode empty();
};
static_assert(sizeof(EightBounds) == sizeof(float) * 4 * EightBounds::width,
              "rectangles have no padding between lanes");
static_assert(sizeof(TreeNode) == sizeof(EightBounds) + EightBounds::width * sizeof(std::int32_t),
              "a node is 160 bytes: two and a half cache lines, without padding");

/// A margin above the rounding to float of coordinates up to `extent_m`, and far above the rounding of doubles and the
/// seal of boxes (world/planar/ray.hpp).
constexpr double float_margin_m(double extent_m) { return extent_m * 0x1p-22 + 1e-6; }

class Tree {
 public:
  /// Over solids with these bounds, numbered from 0.
  explicit Tree(std::span<const Bounds> solids);

  /// Renumbers the solids in the order of the nodes, so that neighbours can be adjacent in memory. Returns the previous
  /// number of each.
  std::vector<std::uint32_t> number_by_nodes();

  /// The root is first; empty without solids.
  std::span<const TreeNode> nodes() const { return nodes_; }
  /// The origin of the rectangles' coordinates, and their greatest magnitude.
  Point middle() const { return middle_; }
  double extent_m() const { return extent_m_; }
  /// Levels of nodes.
  int depth() const { return depth_; }

 private:
  struct Builder;
  void check(std::size_t solids) const;

  std::vector<TreeNode, LargePages<TreeNode>> nodes_;
  Point middle_;
  double extent_m_ = 0;
  int depth_ = 0;
};

}  // namespace waitpoint::world
