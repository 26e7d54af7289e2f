// SPDX-License-Identifier: BSD-3-Clause
// ODE: a geometry per solid in a quadtree, a ray geometry per beam; moving solids are in a separate space.
#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/world/contenders.hpp"

namespace waitpoint::bench {
namespace {

constexpr int quadtree_depth = 7;

/// The nearest hit of a ray so far.
struct Nearest {
  dGeomID own;
  double range_m;
};

void keep_nearest(void* data, dGeomID a, dGeomID b) {
  Nearest& nearest = *static_cast<Nearest*>(data);
  if (a == nearest.own || b == nearest.own) return;
  dContactGeom contact;
  if (dCollide(a, b, 1, &contact, sizeof contact) > 0)
    nearest.range_m = std::min(nearest.range_m, static_cast<double>(contact.depth));
}

class ByOde : public Contender {
 public:
  explicit ByOde(const Place& place) {
    dInitODE2(0);
    const dVector3 middle = {0.5 * place.length_m, 0.5 * place.width_m, 0, 0};
    const dVector3 extents = {place.length_m, place.width_m, 10, 0};
    standing_ = dQuadTreeSpaceCreate(nullptr, middle, extents, quadtree_depth);
    moving_ = dQuadTreeSpaceCreate(nullptr, middle, extents, quadtree_depth);
    for (const world::Shape& shape : place.obstacles) add(standing_, shape);
    for (const world::Shape& shape : place.robots) robots_.push_back(add(moving_, shape));
    ray_ = dCreateRay(nullptr, range_max_m);
    dGeomRaySetClosestHit(ray_, 1);
  }
  ~ByOde() override {
    dGeomDestroy(ray_);
    dSpaceDestroy(moving_);
    dSpaceDestroy(standing_);
    dCloseODE();
  }

  void place(std::span<const world::Shape> robots) override {
    for (std::size_t i = 0; i < robots.size(); ++i) put(robots_[i], robots[i]);
  }

  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    const auto [s, c] = exact::sincos(at.heading);
    for (std::size_t i = 0; i < beams; ++i) {
      const Point d = directions()[i];
      dGeomRaySet(ray_, at.x, at.y, height_m, c * d.x - s * d.y, s * d.x + c * d.y, 0);
      Nearest nearest = {own < robots_.size() ? robots_[own] : nullptr, range_max_m};
      dSpaceCollide2(ray_, reinterpret_cast<dGeomID>(standing_), &nearest, &keep_nearest);
      if (!robots_.empty()) dSpaceCollide2(ray_, reinterpret_cast<dGeomID>(moving_), &nearest, &keep_nearest);
      ranges_m[i] = nearest.range_m;
    }
  }

 private:
  static void put(dGeomID geometry, const world::Shape& shape) {
    dGeomSetPosition(geometry, shape.pose.x, shape.pose.y, 0.5 * (shape.z_low_m + shape.z_high_m));
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, 0, 0, 1, shape.pose.heading);
    dGeomSetRotation(geometry, turned);
  }

  static dGeomID add(dSpaceID space, const world::Shape& shape) {
    const double height_m = shape.z_high_m - shape.z_low_m;
    const dGeomID geometry = shape.kind == world::Shape::Kind::box
                                 ? dCreateBox(space, shape.length_m, shape.width_m, height_m)
                                 : dCreateCylinder(space, shape.radius_m, height_m);
    put(geometry, shape);
    return geometry;
  }

  dSpaceID standing_, moving_;
  dGeomID ray_;
  std::vector<dGeomID> robots_;
};

}  // namespace

std::unique_ptr<Contender> ode(const Place& place) { return std::make_unique<ByOde>(place); }

}  // namespace waitpoint::bench
