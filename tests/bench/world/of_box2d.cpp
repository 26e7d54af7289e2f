// SPDX-License-Identifier: BSD-3-Clause
// Box2D: a body per solid, a ray cast per beam that keeps the nearest fixture.
#include <box2d/box2d.h>

#include "tests/bench/world/contenders.hpp"

namespace waitpoint::bench {
namespace {

class Nearest : public b2RayCastCallback {
 public:
  explicit Nearest(const b2Body* own) : own_(own) {}
  float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float fraction) override {
    if (fixture->GetBody() == own_) return -1;
    nearest = fraction;
    return fraction;
  }
  float nearest = 1;

 private:
  const b2Body* own_;
};

class ByBox2D : public Contender {
 public:
  explicit ByBox2D(const Place& place) {
    for (const world::Shape& shape : place.obstacles) add(shape, b2_staticBody);
    for (const world::Shape& shape : place.robots) robots_.push_back(add(shape, b2_kinematicBody));
  }

  void place(std::span<const world::Shape> robots) override {
    for (std::size_t i = 0; i < robots.size(); ++i) robots_[i]->SetTransform(position(robots[i]), heading(robots[i]));
  }

  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    const auto [s, c] = exact::sincos(at.heading);
    const b2Vec2 from(static_cast<float>(at.x), static_cast<float>(at.y));
    for (std::size_t i = 0; i < beams; ++i) {
      const Point d = range_max_m * directions()[i];
      Nearest nearest(own < robots_.size() ? robots_[own] : nullptr);
      world_.RayCast(&nearest, from,
                     from + b2Vec2(static_cast<float>(c * d.x - s * d.y), static_cast<float>(s * d.x + c * d.y)));
      ranges_m[i] = range_max_m * static_cast<double>(nearest.nearest);
    }
  }

 private:
  static b2Vec2 position(const world::Shape& shape) {
    return {static_cast<float>(shape.pose.x), static_cast<float>(shape.pose.y)};
  }
  static float heading(const world::Shape& shape) { return static_cast<float>(shape.pose.heading); }

  b2Body* add(const world::Shape& shape, b2BodyType type) {
    b2BodyDef definition;
    definition.type = type;
    definition.position = position(shape);
    definition.angle = heading(shape);
    b2Body* body = world_.CreateBody(&definition);
    if (shape.kind == world::Shape::Kind::box) {
      b2PolygonShape polygon;
      polygon.SetAsBox(static_cast<float>(0.5 * shape.length_m), static_cast<float>(0.5 * shape.width_m));
      body->CreateFixture(&polygon, 0);
    } else {
      b2CircleShape circle;
      circle.m_radius = static_cast<float>(shape.radius_m);
      body->CreateFixture(&circle, 0);
    }
    return body;
  }

  b2World world_{b2Vec2(0, 0)};
  std::vector<b2Body*> robots_;
};

}  // namespace

std::unique_ptr<Contender> box2d(const Place& place) { return std::make_unique<ByBox2D>(place); }

}  // namespace waitpoint::bench
