// SPDX-License-Identifier: BSD-3-Clause
// A body that is guided from outside, in place of commands.
#include <gtest/gtest.h>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

const BodyId guided{0}, other{1};

WorldDescription two_bodies() {
  WorldDescription description;
  description.bodies.push_back(nimble_body("guided", cylinder({0, 0}, 0.25), {0, 0, 0}));
  description.bodies.push_back(nimble_body("other", cylinder({0, 0}, 0.25), {2, 0, 0}));
  return description;
}

TEST(Guidance, MovesABodyToAPoseInOneStepAndThenOnAtItsSpeed) {
  const auto world = make_kinematic_world(two_bodies(), 1);
  world->command(guided, {1, 0});
  EXPECT_EQ(world->guide_body(guided, Pose{0.3, -0.2, 0.5}, {0, 0.4, 2}), std::nullopt);
  world->step();
  const BodyState& body = world->body(guided);
  EXPECT_NEAR(length(body.pose.position() - Point{0.3, -0.2}), 0, 1e-12);
  EXPECT_NEAR(body.pose.heading, 0.5, 1e-12);
  EXPECT_EQ(body.velocity, (Velocity{0, 0.4, 2}));
  const Pose then = Arc::of(body.pose, {0, 0.4, 2}, 0.01).end();
  world->step();
  EXPECT_EQ(body.pose, then) << "the command does not count";
  world->guide_body(guided, std::nullopt, {});
  world->step();
  EXPECT_EQ(body.pose, then);
}

TEST(Guidance, EndsAtContactsAndIsSeen) {
  const auto world = make_kinematic_world(two_bodies(), 1);
  world->guide_body(guided, Pose{1.8, 0, 0}, {});
  world->step();
  EXPECT_NEAR(world->body(guided).pose.x, 1.5, 1e-5);
  EXPECT_TRUE(world->body(guided).stalled);
  EXPECT_EQ(world->body(guided).collisions, 1u);
  world->guide_body(guided, Pose{1, 0, 0}, {});
  world->step();
  EXPECT_FALSE(world->body(guided).stalled);
  world->step();
  EXPECT_NEAR(world->cast({{2, 0}, exact::pi, 0.5}, 10, other), 0.75, 1e-9);
}

}  // namespace
}  // namespace waitpoint::world
