// SPDX-License-Identifier: BSD-3-Clause
#include "world/fcl/mesh_tree.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "world/fcl/geometry.hpp"
#include "world/fcl/scene.hpp"
#include "world/fcl/wedge.hpp"
#include "world/mesh/section.hpp"

namespace waitpoint::world {
namespace {

template <class Volume>
std::shared_ptr<fcl::BVHModel<Volume>> model_of(std::span<const Triangle> triangles) {
  std::vector<fcl::Vector3d> corners;
  std::vector<fcl::Triangle> numbers;
  for (const Triangle& triangle : triangles) {
    const std::size_t first = corners.size();
    for (const SpaceVector& corner : triangle.corners) corners.emplace_back(corner.x, corner.y, corner.z);
    numbers.emplace_back(first, first + 1, first + 2);
  }
  auto model = std::make_shared<fcl::BVHModel<Volume>>();
  const bool made =
      model->beginModel(static_cast<int>(numbers.size()), static_cast<int>(corners.size())) == fcl::BVH_OK &&
      model->addSubModel(corners, numbers) == fcl::BVH_OK && model->endModel() == fcl::BVH_OK;
  WAITPOINT_CHECK(made, "FCL makes no model of a mesh");
  return model;
}

fcl::AABBd padded(const fcl::AABBd& box) {
  const fcl::Vector3d padding = fcl::Vector3d::Constant(Scene::padding_m);
  return fcl::AABBd(box.min_ - padding, box.max_ + padding);
}

bool has(const fcl::AABBd& box, double height_m) { return box.min_[2] <= height_m && height_m <= box.max_[2]; }

struct Pending {
  int node;
  double entry_m2;
};

}  // namespace

struct MeshTree::Models {
  std::vector<Triangle> triangles;
  // Axis-parallel boxes are fastest for rays; but FCL's narrow phase copies such a model in every query.
  std::shared_ptr<fcl::BVHModel<fcl::AABBd>> boxes;
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> turned_boxes;  // for the narrow phase; built on first use
  std::vector<Pending> pending;                               // scratch space of one call

  void cast(Point origin, std::span<const Point> directions, double height_m, std::span<double> ranges_m) {
    const Wedge wedge = {origin, directions.front(), directions.back()};
    double limit_m2 = farthest_m2(ranges_m);
    const auto entry = [&](int node) {
      const fcl::AABBd box = padded(boxes->getBV(node).bv);
      return has(box, height_m) ? wedge.entry(box) : no_hit;
    };
    pending.assign(1, {0, 0});
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      if (next.entry_m2 > limit_m2) continue;
      const auto& node = boxes->getBV(next.node);
      if (!node.isLeaf()) {
        Pending near = {node.leftChild(), entry(node.leftChild())}, far = {node.rightChild(), entry(node.rightChild())};
        if (far.entry_m2 < near.entry_m2) std::swap(near, far);
        if (far.entry_m2 <= limit_m2 && far.entry_m2 < no_hit) pending.push_back(far);
        if (near.entry_m2 <= limit_m2 && near.entry_m2 < no_hit) pending.push_back(near);
        continue;
      }
      WAITPOINT_FAST_CHECK(static_cast<std::size_t>(node.primitiveId()) < triangles.size(),
                           "a leaf of FCL's tree is of a triangle that does not exist");
      const std::optional<Outline> segment = cut(triangles[static_cast<std::size_t>(node.primitiveId())], height_m);
      if (!segment) continue;
      for (std::size_t i = 0; i < directions.size(); ++i)
        ranges_m[i] = std::min(ranges_m[i], hit_distance(*segment, {origin, directions[i]}));
      limit_m2 = farthest_m2(ranges_m);
    }
  }
};

MeshTree::MeshTree(std::span<const MeshObstacle> meshes) : models_(std::make_unique<Models>()) {
  for (const MeshObstacle& mesh : meshes)
    for (std::size_t i = 0; i < mesh.mesh->triangles.size(); ++i) models_->triangles.push_back(mesh.mesh->triangle(i));
  if (!models_->triangles.empty()) models_->boxes = model_of<fcl::AABBd>(models_->triangles);
}

MeshTree::~MeshTree() = default;
MeshTree::MeshTree(MeshTree&&) noexcept = default;
MeshTree& MeshTree::operator=(MeshTree&&) noexcept = default;

void MeshTree::cast(Point origin, std::span<const Point> directions, double height_m,
                    std::span<double> ranges_m) const {
  WAITPOINT_CHECK(directions.size() == ranges_m.size(), "there are not as many directions as ranges");
  if (models_->triangles.empty()) return;
  for_each_wedge(directions, [&](std::size_t first, std::size_t count) {
    models_->cast(origin, directions.subspan(first, count), height_m, ranges_m.subspan(first, count));
  });
}

bool MeshTree::collides(const Shape& shape) const {
  if (models_->triangles.empty()) return false;
  if (models_->turned_boxes == nullptr) models_->turned_boxes = model_of<fcl::OBBRSSd>(models_->triangles);
  const fcl::CollisionObjectd mesh(models_->turned_boxes);
  const fcl::CollisionObjectd probe(geometry_of(shape), transform_of(outline_of(shape), shape.z_low_m, shape.z_high_m));
  fcl::CollisionResultd result;
  return fcl::collide(&mesh, &probe, fcl::CollisionRequestd(), result) > 0;
}

}  // namespace waitpoint::world
