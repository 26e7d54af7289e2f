// SPDX-License-Identifier: BSD-3-Clause
// Standing solids, cut at one height: the outlines of those that reach it, and a tree over them. What meshes come to at
// that height is given, as segments.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/large_pages.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

/// Whether the height is within the solid, its lower and upper face included.
inline bool reaches(const Shape& shape, double height_m) {
  return shape.z_low_m <= height_m && height_m <= shape.z_high_m;
}

class Slice {
 public:
  /// Of shapes that are numbered from 0; those that do not reach the height have no part in it.
  Slice(std::span<const Shape> shapes, double height_m) : Slice(shapes, height_m, {}, {}) {}
  /// And of outlines besides, each a solid of that number.
  Slice(std::span<const Shape> shapes, double height_m, std::span<const Outline> others,
        std::span<const std::uint32_t> solids_of_others);

  double height_m() const { return height_m_; }
  const Tree& tree() const { return tree_; }
  /// A solid by its number in the tree, and its own number.
  const Outline& outline(std::size_t in_tree) const { return outlines_[in_tree]; }
  std::uint32_t solid(std::size_t in_tree) const { return solids_[in_tree]; }

 private:
  double height_m_;
  std::vector<std::shared_ptr<const ConvexPolygon>> polygons_;  // of the outlines
  std::vector<Outline, LargePages<Outline>> outlines_;
  std::vector<std::uint32_t> solids_;
  Tree tree_;
};

}  // namespace waitpoint::world
