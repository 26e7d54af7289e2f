// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/bumpers.hpp"

#include <gtest/gtest.h>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

WorldDescription facing_a_wall(double heading) {
  WorldDescription description;
  description.obstacles.push_back({"wall", box({1.5, 0, 0}, 1, 9), true});  // its face at x = 1
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.25), {0, 0, heading}));
  description.bodies[0].sensors<Bumpers>().emplace();
  return description;
}

TEST(Bumper, ThePanelThatMeetsTheWallIsPressedWhileItTouches) {
  const auto world = make_kinematic_world(facing_a_wall(0), 1);
  EXPECT_EQ(reading<Bumpers>(*world).pressed, 0u);
  world->command(BodyId(0), {20, 0});
  for (int i = 0; i < 5; ++i) world->step();
  EXPECT_TRUE(world->body(BodyId(0)).stalled);
  EXPECT_EQ(reading<Bumpers>(*world).pressed, 1u);
  world->command(BodyId(0), {-0.5, 0});
  world->step();
  EXPECT_EQ(reading<Bumpers>(*world).pressed, 0u) << "5 mm away";
}

TEST(Bumper, PanelsLookAroundCounterClockwise) {
  const double panel_rad = 2 * exact::pi / 14;
  for (const int panel : {1, 3, 7, 11, 13}) {
    const auto world = make_kinematic_world(facing_a_wall(-panel * panel_rad + 0.1), 1);
    ASSERT_EQ(world->move_body(BodyId(0), {0.7495, 0, -panel * panel_rad + 0.1}), std::nullopt);
    EXPECT_EQ(reading<Bumpers>(*world).pressed, 1u << panel);
  }
}

TEST(Bumper, TwoWallsPressTwoPanelsAndOnlyWhatIsAsHigh) {
  WorldDescription description = facing_a_wall(0);
  description.obstacles.push_back({"left", box({0, 1.5, 0}, 9, 1), true});
  Shape low = box({0, -1.5, 0}, 9, 1);
  low.z_high_m = 0.05;
  description.obstacles.push_back({"sill", low, true});
  description.bodies[0].shape.z_low_m = 0.06;
  const auto world = make_kinematic_world(description, 1);
  ASSERT_EQ(world->move_body(BodyId(0), {0.7495, 0.7495, 0.1}), std::nullopt);
  EXPECT_EQ(reading<Bumpers>(*world).pressed, 1u << 0 | 1u << 3);
  ASSERT_EQ(world->move_body(BodyId(0), {0, -0.7495, 0.1}), std::nullopt);
  EXPECT_EQ(reading<Bumpers>(*world).pressed, 0u);
}

TEST(Bumper, AnotherRobotPressesToo) {
  WorldDescription description = facing_a_wall(0);
  description.bodies.push_back(nimble_body("other", box({0, 0, 0}, 0.5, 0.5), {-0.5005, 0, 0}));
  const auto world = make_kinematic_world(description, 1);
  EXPECT_EQ(reading<Bumpers>(*world).pressed, 1u << 7);
}

}  // namespace
}  // namespace waitpoint::world
