// SPDX-License-Identifier: BSD-3-Clause
// A bounding-volume tree, eight children wide, over solids that stand still.
//
// Its rectangles are of floats, relative to the middle of all, and a little too large: they only cull. First all is
// halved, again and again, by the sweep that makes perimeter times count least; then nodes of eight take in those
// halves with which the perimeters of all nodes are least in sum.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/large_pages.hpp"

namespace waitpoint::world {

/// Eight rectangles, as a walk looks at them: all at once.
struct alignas(32) EightBounds {
  static constexpr int width = 8;
  float low_x[width], low_y[width], high_x[width], high_y[width];

  /// Rectangles that nobody sees.
  static EightBounds nowhere();
  /// Sets one to `bounds` relative to `middle`, grown by `margin_m`, which must exceed the rounding to float.
  void set(int at, const Bounds& bounds, Point middle, double margin_m);
};

struct TreeNode {
  /// In place of a child; its rectangle is nowhere.
  static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();

  EightBounds bounds;
  /// Of each rectangle: another node, or ~number of a solid; where there are fewer than eight, none are the last ones.
  std::array<std::int32_t, EightBounds::width> child;

  static TreeNode empty();
};

/// How far coordinates of at most `extent_m`, rounded to float, can lie beside themselves, and much more than doubles
/// and sealed boxes (world/planar/hit.cpp) can.
constexpr double float_margin_m(double extent_m) { return extent_m * 0x1p-22 + 1e-6; }

class Tree {
 public:
  /// Over solids with these bounds, numbered from 0.
  explicit Tree(std::span<const Bounds> solids);

  /// Numbers the solids anew, in the order in which its nodes have them, so that neighbours can lie side by side in
  /// memory. Gives the number that each had before.
  std::vector<std::uint32_t> number_by_nodes();

  /// The first is the root; none over nothing.
  std::span<const TreeNode> nodes() const { return nodes_; }
  /// What the rectangles are relative to, and the greatest coordinate there.
  Point middle() const { return middle_; }
  double extent_m() const { return extent_m_; }
  /// Nodes above each other, at most.
  int depth() const { return depth_; }

 private:
  struct Builder;

  std::vector<TreeNode, LargePages<TreeNode>> nodes_;
  Point middle_;
  double extent_m_ = 0;
  int depth_ = 0;
};

}  // namespace waitpoint::world
