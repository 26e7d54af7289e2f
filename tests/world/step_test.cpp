// SPDX-License-Identifier: BSD-3-Clause
// The world's step is configurable: trajectories converge as it becomes finer.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

using Kind = BaseDescription::Kind;

struct Place {
  Pose pose;
  double height_m;
};

// The place of a body after 3.2 s of four commands, none of which it can obey at once.
Place place_after(Kind kind, std::int64_t step_ms) {
  WorldDescription description;
  description.step = Duration(std::chrono::milliseconds(step_ms));
  BodyDescription body = nimble_body("robot", cylinder({0, 0}, 0.25), {0, 0, 0.3});
  body.base = {};
  body.base.kind = kind;
  body.base.v_acceleration_m_s2 = 0.7;
  body.base.w_acceleration_rad_s2 = 0.9;
  body.base.climb_acceleration_m_s2 = 0.5;
  description.bodies.push_back(body);
  const auto world = make_kinematic_world(description, 1);
  for (const Velocity& wanted :
       {Velocity{0.8, 0.9, 0.2, 0.3}, {0.3, -0.7, -0.3, 0.4}, {0.9, 0.4, 0, -0.2}, {-0.2, 0.8, 0.4, 0.1}}) {
    world->command(BodyId(0), wanted);
    for (std::int64_t t = 0; t < 800; t += step_ms) world->step();
  }
  return {world->body(BodyId(0)).pose, world->body(BodyId(0)).height_m};
}

// Half the step, half the error: each step has the velocity of its end, so the error is of first order.
TEST(WorldStep, TrajectoriesConvergeOverFourStepSizes) {
  for (const Kind kind :
       {Kind::differential, Kind::synchro, Kind::omni, Kind::ackermann, Kind::skid_steer, Kind::aerial}) {
    // Extrapolation: twice the finer result minus the coarser one has no first-order error.
    const Place fine = place_after(kind, 1), coarser = place_after(kind, 2);
    const Place limit = {{2 * fine.pose.x - coarser.pose.x, 2 * fine.pose.y - coarser.pose.y,
                          2 * fine.pose.heading - coarser.pose.heading},
                         2 * fine.height_m - coarser.height_m};
    double before = 0;
    for (const std::int64_t step_ms : {80, 40, 20, 10}) {
      const Place place = place_after(kind, step_ms);
      const double error =
          std::hypot(std::hypot(place.pose.x - limit.pose.x, place.pose.y - limit.pose.y),
                     std::hypot(place.pose.heading - limit.pose.heading, place.height_m - limit.height_m));
      if (before > 0) {
        EXPECT_NEAR(before / error, 2, 0.35) << "kind " << static_cast<int>(kind) << ", " << step_ms << " ms";
      }
      before = error;
    }
    EXPECT_LT(before, 0.02) << "at 10 ms";
  }
}

// The end of a path at a wall depends on the wall, not on the step.
TEST(WorldStep, AContactIsWhereItIsAtEveryStep) {
  for (const std::int64_t step_ms : {100, 40, 10, 4}) {
    WorldDescription description;
    description.step = Duration(std::chrono::milliseconds(step_ms));
    description.obstacles.push_back({"wall", box({2.0005, 0, 0}, 0.001, 10), true});
    description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.25), {0, 0, 0}));
    const auto world = make_kinematic_world(description, 1);
    world->command(BodyId(0), {1.3, 0});
    for (std::int64_t t = 0; t < 2000; t += step_ms) world->step();
    EXPECT_NEAR(world->body(BodyId(0)).pose.x, 1.75 - 1e-6, 1e-8);
    EXPECT_EQ(world->body(BodyId(0)).collisions, 1u);
  }
}

}  // namespace
}  // namespace waitpoint::world
