// SPDX-License-Identifier: BSD-3-Clause
#include "world/mesh/surfaces.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "world/slice/overlap_walk.hpp"

namespace waitpoint::world {
namespace {

std::vector<Bounds> bounds_of_all(std::span<const Outline> outlines) {
  std::vector<Bounds> bounds;
  bounds.reserve(outlines.size());
  for (const Outline& outline : outlines) bounds.push_back(bounds_of(outline));
  return bounds;
}

}  // namespace

Surfaces::Surfaces(std::span<const MeshObstacle> meshes) : tree_(std::span<const Bounds>()) {
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh) {
    WAITPOINT_CHECK(meshes[mesh].mesh != nullptr, "a mesh obstacle has no mesh");
    for (std::size_t i = 0; i < meshes[mesh].mesh->triangles.size(); ++i) {
      for (const std::uint32_t corner : meshes[mesh].mesh->triangles[i])
        WAITPOINT_CHECK(corner < meshes[mesh].mesh->corners.size(), "a triangle names a corner that its mesh lacks");
      triangles_.push_back(meshes[mesh].mesh->triangle(i));
      meshes_.push_back(mesh);
      const std::array<SpaceVector, 3>& c = triangles_.back().corners;
      outlines_.push_back(triangle_outline({c[0].x, c[0].y}, {c[1].x, c[1].y}, {c[2].x, c[2].y}));
    }
  }
  tree_ = Tree(bounds_of_all(outlines_));
}

void Surfaces::near(const Bounds& bounds, double z_low_m, double z_high_m, std::vector<std::uint32_t>& found) const {
  found.clear();
  walk_overlapping(
      tree_.nodes(), {bounds.low - tree_.middle(), bounds.high - tree_.middle()}, float_margin_m(tree_.extent_m()),
      kernels(), [&](std::uint32_t number) {
        const Triangle& triangle = triangles_[number];
        if (triangle.low_m() < z_high_m && z_low_m < triangle.high_m() && bounds.overlaps(bounds_of(outlines_[number])))
          found.push_back(number);
        return true;
      });
  std::sort(found.begin(), found.end());
}

Separation Surfaces::separation(const Outline& body, double z_low_m, double z_high_m, std::uint32_t number) const {
  WAITPOINT_FAST_CHECK(number < triangles_.size(), "the separation of a triangle that does not exist is asked for");
  Separation least = {std::numeric_limits<double>::infinity(), {1, 0}};
  pieces_.clear();
  cover(triangles_[number], z_low_m, z_high_m, pieces_);
  for (const Outline& piece : pieces_) {
    const Separation s = world::separation(body, piece);
    if (s.distance_m < least.distance_m) least = s;
  }
  return least;
}

Surfaces::Cut Surfaces::cut(double height_m) const {
  Cut all;
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    if (const std::optional<Outline> segment = world::cut(triangles_[i], height_m)) {
      all.segments.push_back(*segment);
      all.meshes.push_back(meshes_[i]);
    }
  }
  return all;
}

}  // namespace waitpoint::world
