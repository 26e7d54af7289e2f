// SPDX-License-Identifier: BSD-3-Clause
// The triangles of all meshes that stand in a world, under a tree as they are seen from above: which of them an upright
// body is near to, and how near.
//
// What a body can meet of a triangle is what lies between its own lowest and highest height; that part, seen from
// above, is met or not as the body's outline and it overlap or not. This is exact, for a body is upright.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "world/mesh/section.hpp"
#include "world/planar/separation.hpp"
#include "world/slice/kernels.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

class Surfaces {
 public:
  /// Triangles are numbered from 0 through all meshes, in their order.
  explicit Surfaces(std::span<const MeshObstacle> meshes);

  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  const Triangle& triangle(std::uint32_t number) const { return triangles_[number]; }
  /// Which of the meshes it is of.
  std::uint32_t mesh(std::uint32_t number) const { return meshes_[number]; }
  /// All of it, as seen from above.
  const Outline& outline(std::uint32_t number) const { return outlines_[number]; }

  /// Those that have heights in the open interval and whose bounds overlap these, in ascending order; `found` is
  /// overwritten.
  void near(const Bounds& bounds, double z_low_m, double z_high_m, std::vector<std::uint32_t>& found) const;

  /// The separation of a body of that outline from what of the triangle is within its open interval of heights; without
  /// any, it is infinite.
  Separation separation(const Outline& body, double z_low_m, double z_high_m, std::uint32_t number) const;

  /// What is cut at that height, and of which mesh each segment is.
  struct Cut {
    std::vector<Outline> segments;
    std::vector<std::uint32_t> meshes;
  };
  Cut cut(double height_m) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> meshes_;
  std::vector<Outline> outlines_;
  Tree tree_;
  mutable std::vector<Outline> pieces_;  // of one call, kept so that asking allocates nothing
};

}  // namespace waitpoint::world
