// SPDX-License-Identifier: BSD-3-Clause
// Dynamic worlds for tests; skipped if this library was built without Bullet.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/world/scenes.hpp"
#include "world/bullet/bullet_world.hpp"

namespace waitpoint::world {

inline constexpr double g_m_s2 = 9.81;

class DynamicWorldTest : public testing::Test {
 protected:
  void SetUp() override {
    if (make_bullet_world({}, 1) == nullptr) GTEST_SKIP() << "built without Bullet";
  }

  /// A box of 0.6 m x 0.4 m x 0.5 m.
  static Obstacle loose_box(const std::string& name, const Pose& pose, double mass_kg, double friction = 0.3) {
    Shape shape = box(pose, 0.6, 0.4);
    shape.z_high_m = 0.5;
    return {name, shape, true, mass_kg, friction};
  }

  static Obstacle wall(const Pose& pose, double length_m, double width_m) {
    return {"wall", box(pose, length_m, width_m), true};
  }

  /// A round robot of 50 kg, with a perfect odometer.
  static BodyDescription robot(const std::string& name, const Pose& start) {
    BodyDescription body;
    body.name = name;
    body.shape = cylinder({0, 0}, 0.25);
    body.start = start;
    return body;
  }

  void start() { world_ = make_bullet_world(description_, 1); }
  void run(double time_s) {
    const auto steps = std::lround(time_s / description_.step.seconds());
    for (long k = 0; k < steps; ++k) world_->step();
  }
  const BodyState& body() const { return world_->body(BodyId(0)); }
  const Shape& obstacle(std::size_t number) const { return world_->description().obstacles[number].shape; }

  WorldDescription description_;
  std::unique_ptr<VehicleWorld> world_;
};

}  // namespace waitpoint::world
