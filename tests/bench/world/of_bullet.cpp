// SPDX-License-Identifier: BSD-3-Clause
// Bullet: a collision object per solid in its dynamic tree, a ray test per beam.
#include <btBulletCollisionCommon.h>

#include "tests/bench/world/contenders.hpp"

namespace waitpoint::bench {
namespace {

class Nearest : public btCollisionWorld::ClosestRayResultCallback {
 public:
  Nearest(const btVector3& from, const btVector3& to, const btCollisionObject* own)
      : ClosestRayResultCallback(from, to), own_(own) {}
  bool needsCollision(btBroadphaseProxy* proxy) const override { return proxy->m_clientObject != own_; }

 private:
  const btCollisionObject* own_;
};

class ByBullet : public Contender {
 public:
  explicit ByBullet(const Place& place) : dispatcher_(&configuration_), world_(&dispatcher_, &tree_, &configuration_) {
    for (const world::Shape& shape : place.obstacles) add(shape);
    for (const world::Shape& shape : place.robots) robots_.push_back(add(shape));
  }
  ~ByBullet() override {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  void place(std::span<const world::Shape> robots) override {
    for (std::size_t i = 0; i < robots.size(); ++i) {
      robots_[i]->setWorldTransform(where(robots[i]));
      world_.updateSingleAabb(robots_[i]);
    }
  }

  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    const auto [s, c] = exact::sincos(at.heading);
    const btVector3 from(at.x, at.y, height_m);
    for (std::size_t i = 0; i < beams; ++i) {
      const Point d = range_max_m * directions()[i];
      const btVector3 to = from + btVector3(c * d.x - s * d.y, s * d.x + c * d.y, 0);
      Nearest nearest(from, to, own < robots_.size() ? robots_[own] : nullptr);
      world_.rayTest(from, to, nearest);
      ranges_m[i] = range_max_m * nearest.m_closestHitFraction;
    }
  }

 private:
  static btTransform where(const world::Shape& shape) {
    return btTransform(btQuaternion(btVector3(0, 0, 1), shape.pose.heading),
                       btVector3(shape.pose.x, shape.pose.y, 0.5 * (shape.z_low_m + shape.z_high_m)));
  }

  btCollisionObject* add(const world::Shape& shape) {
    const double half_height_m = 0.5 * (shape.z_high_m - shape.z_low_m);
    if (shape.kind == world::Shape::Kind::box)
      shapes_.push_back(
          std::make_unique<btBoxShape>(btVector3(0.5 * shape.length_m, 0.5 * shape.width_m, half_height_m)));
    else
      shapes_.push_back(std::make_unique<btCylinderShapeZ>(btVector3(shape.radius_m, shape.radius_m, half_height_m)));
    btCollisionObject& object = *objects_.emplace_back(std::make_unique<btCollisionObject>());
    object.setCollisionShape(shapes_.back().get());
    object.setWorldTransform(where(shape));
    world_.addCollisionObject(&object);
    return &object;
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase tree_;
  btCollisionWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<btCollisionObject*> robots_;
};

}  // namespace

std::unique_ptr<Contender> bullet(const Place& place) { return std::make_unique<ByBullet>(place); }

}  // namespace waitpoint::bench
