// SPDX-License-Identifier: BSD-3-Clause
// Meshes in FCL's bounding-volume hierarchy.
//
// FCL knows them as a BVHModel of triangles, which its narrow phase can be asked about. Level rays come from an own
// walk of that model's tree (FCL 0.7 has no rays): what of it is at the ray's height and in its way; each triangle that
// is reached is cut at the height (world/mesh/section.hpp), and hit_distance() is asked of the segment. So ranges are
// those of asking every triangle, to the last bit, and those of a slice.
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

  /// Casts a fan of rays as Scene::cast() does.
  void cast(Point origin, std::span<const Point> directions, double height_m, std::span<double> ranges_m) const;

  /// Whether an upright solid standing there would collide with any triangle, by FCL's narrow phase.
  bool collides(const Shape& shape) const;

 private:
  struct Models;
  std::unique_ptr<Models> models_;
};

}  // namespace waitpoint::world
