// SPDX-License-Identifier: BSD-3-Clause
// A horizontal section of the fixed solids at one height: the outlines of the solids that reach it, and a tree over
// them. Sections of meshes are supplied by the caller, as segments.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/large_pages.hpp"
#include "world/planar/outline.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

/// True if the height is within the solid, its lower and upper face included.
inline bool reaches(const Shape& shape, double height_m) {
  return shape.z_low_m <= height_m && height_m <= shape.z_high_m;
}

class Slice {
 public:
  /// Shapes are numbered from 0; those that do not reach the height are left out.
  Slice(std::span<const Shape> shapes, double height_m) : Slice(shapes, height_m, {}, {}) {}
  /// With further outlines, and the number of the solid of each: as many numbers as outlines.
  Slice(std::span<const Shape> shapes, double height_m, std::span<const Outline> others,
        std::span<const std::uint32_t> solids_of_others);

  double height_m() const { return height_m_; }
  const Tree& tree() const { return tree_; }
  /// The outline and the solid's number of an index in the tree.
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
