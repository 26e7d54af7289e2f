// SPDX-License-Identifier: BSD-3-Clause
// The triangles of all meshes of a world, under a tree of their projections onto the plane: finds the triangles near an
// upright body, and their distances.
//
// A body can meet only the part of a triangle between its own lowest and highest height, and meets it if and only if
// the projection of that part overlaps the body's outline. This is exact, since bodies are upright.
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
  /// Triangles are numbered from 0, through all meshes in their order.
  explicit Surfaces(std::span<const MeshObstacle> meshes);

  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  const Triangle& triangle(std::uint32_t number) const { return triangles_[number]; }
  /// The index of its mesh.
  std::uint32_t mesh(std::uint32_t number) const { return meshes_[number]; }
  /// The projection of the whole triangle.
  const Outline& outline(std::uint32_t number) const { return outlines_[number]; }

  /// The triangles with heights in the open interval and bounds that overlap these, in ascending order; `found` is
  /// overwritten.
  void near(const Bounds& bounds, double z_low_m, double z_high_m, std::vector<std::uint32_t>& found) const;

  /// The separation of a body with that outline from the triangle's part in the open interval of heights; infinite if
  /// there is no such part.
  Separation separation(const Outline& body, double z_low_m, double z_high_m, std::uint32_t number) const;

  /// The segments of the section at one height, and the index of each one's mesh.
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
  mutable std::vector<Outline> pieces_;  // scratch space of one call, kept so that queries allocate nothing
};

}  // namespace waitpoint::world
