// SPDX-License-Identifier: BSD-3-Clause
// FCL in its usual use: a dynamic tree of axis-parallel boxes, and collide() of an upright cylinder with it. A mesh is
// one object, a BVHModel of oriented boxes with swept spheres.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>

#include "core/error.hpp"
#include "tests/bench/world/contenders.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::bench {
namespace {

std::unique_ptr<fcl::CollisionObjectd> object_of(const world::Shape& shape) {
  const double height = shape.z_high_m - shape.z_low_m;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  if (shape.kind == world::Shape::Kind::box)
    geometry = std::make_shared<fcl::Boxd>(shape.length_m, shape.width_m, height);
  else
    geometry = std::make_shared<fcl::Cylinderd>(shape.radius_m, height);
  const world::Outline outline = world::outline_of(shape);
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() << outline.axis_cos, -outline.axis_sin, 0, outline.axis_sin, outline.axis_cos, 0, 0, 0, 1;
  transform.translation() << outline.centre.x, outline.centre.y, 0.5 * (shape.z_low_m + shape.z_high_m);
  auto object = std::make_unique<fcl::CollisionObjectd>(geometry, transform);
  object->computeAABB();
  return object;
}

std::unique_ptr<fcl::CollisionObjectd> object_of(const world::TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> corners;
  std::vector<fcl::Triangle> triangles;
  for (const world::SpaceVector& corner : mesh.corners) corners.emplace_back(corner.x, corner.y, corner.z);
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  WAITPOINT_CHECK(model->beginModel() == fcl::BVH_OK && model->addSubModel(corners, triangles) == fcl::BVH_OK &&
                      model->endModel() == fcl::BVH_OK,
                  "FCL makes no model of a mesh");
  auto object = std::make_unique<fcl::CollisionObjectd>(model, fcl::Transform3d::Identity());
  object->computeAABB();
  return object;
}

bool keep_first(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto& result = *static_cast<fcl::CollisionResultd*>(data);
  return fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0;
}

class ByFcl : public Collider {
 public:
  explicit ByFcl(const Place& place) {
    std::vector<fcl::CollisionObjectd*> all;
    for (const world::Shape& shape : place.obstacles) obstacles_.push_back(object_of(shape));
    for (const world::MeshObstacle& mesh : place.meshes) obstacles_.push_back(object_of(*mesh.mesh));
    for (const auto& obstacle : obstacles_) all.push_back(obstacle.get());
    manager_.registerObjects(all);
    world::Shape robot;
    robot.kind = world::Shape::Kind::cylinder;
    robot.radius_m = robot_radius_m;
    robot.z_low_m = robot_low_m;
    robot.z_high_m = robot_high_m;
    robot_ = object_of(robot);
  }
  bool collides(Point centre) override {
    robot_->setTranslation({centre.x, centre.y, 0.5 * (robot_low_m + robot_high_m)});
    robot_->computeAABB();
    fcl::CollisionResultd result;
    manager_.collide(robot_.get(), &result, &keep_first);
    return result.isCollision();
  }

 private:
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> obstacles_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  std::unique_ptr<fcl::CollisionObjectd> robot_;
};

}  // namespace

std::unique_ptr<Collider> fcl_collide(const Place& place) { return std::make_unique<ByFcl>(place); }

}  // namespace waitpoint::bench
