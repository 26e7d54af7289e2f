// SPDX-License-Identifier: BSD-3-Clause
// Meshes in FCL's bounding-volume hierarchy.
//
// A mesh is a BVHModel of triangles, which FCL's narrow phase can query. FCL 0.7 has no ray queries: level rays use an
// own walk of that model's tree, restricted to the nodes at the ray's height and in its way. Each triangle reached is
// cut at the height (world/mesh/section.hpp), and its segment is tested with hit_distance(). So ranges equal those of a
// test of every triangle, and those of a slice, to the last bit.
#pragma once

#include <memory>
#include <span>

#include "world/planar/ray.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

class MeshTree {
 public:
  explicit MeshTree(std::span<const MeshObstacle> meshes);
  ~MeshTree();
  MeshTree(MeshTree&&) noexcept;
  MeshTree& operator=(MeshTree&&) noexcept;

  /// Casts a fan of rays; see Scene::cast().
  void cast(Point origin, std::span<const Point> directions, double height_m, std::span<double> ranges_m) const;

  /// True if an upright solid collides with any triangle, by FCL's narrow phase.
  bool collides(const Shape& shape) const;

 private:
  struct Models;
  std::unique_ptr<Models> models_;
};

}  // namespace waitpoint::world
