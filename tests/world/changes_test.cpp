// SPDX-License-Identifier: BSD-3-Clause
// Interventions in a world between its steps.
#include <gtest/gtest.h>

#include "tests/world/scenes.hpp"
#include "world/world.hpp"

namespace waitpoint::world {
namespace {

const Shape disc = cylinder({0, 0}, 0.25);
const BodyId robot{0}, other{1};

WorldDescription two_and_a_wall() {
  WorldDescription description;
  description.obstacles.push_back({"wall", box({5, 0, 0}, 0.2, 10), true});
  description.bodies.push_back(nimble_body("robot", disc, {0, 0, 0}));
  description.bodies.push_back(nimble_body("other", disc, {0, 3, 0}));
  description.bodies[0].sensors<Lasers>().push_back(perfect_laser(0.4));
  return description;
}

constexpr double cast_m = 1e-11;  // a box is sealed by 1e-12 m (slice/tree.cpp), and a range rounds

double ahead_m(const World& world, Point from = {0, 0}) { return world.cast({from, 0, 0.4}, 30, robot); }

TEST(WorldChanges, AMovedBodyStandsThereAtRestAndItsOdometerDoesNotKnow) {
  const auto world = make_kinematic_world(two_and_a_wall(), 1);
  world->command(robot, {1, 0});
  world->step();
  const OdometerReading before = world->odometer(robot);
  const double travelled_m = world->body(robot).travelled_m;
  EXPECT_EQ(world->move_body(robot, {2, 2, 1}), std::nullopt);
  EXPECT_EQ(world->body(robot).pose, (Pose{2, 2, 1}));
  EXPECT_EQ(world->body(robot).velocity, Velocity());
  EXPECT_EQ(world->body(robot).travelled_m, travelled_m);
  EXPECT_EQ(world->odometer(robot).travel_units, before.travel_units);
  EXPECT_EQ(world->odometer(robot).turn_units, before.turn_units);
  world->step();
  EXPECT_NEAR(length(world->body(robot).pose.position() - Point{2, 2}), 0.01, 1e-12) << "its command holds";
}

TEST(WorldChanges, OthersSeeAMovedBodyAndRunIntoIt) {
  const auto world = make_kinematic_world(two_and_a_wall(), 1);
  EXPECT_NEAR(ahead_m(*world), 4.9, cast_m);
  EXPECT_EQ(world->move_body(other, {2, 0, 0}), std::nullopt);
  EXPECT_NEAR(ahead_m(*world), 1.75, cast_m);
  world->command(robot, {1, 0});
  for (int i = 0; i < 300; ++i) world->step();
  EXPECT_TRUE(world->body(robot).stalled);
  EXPECT_NEAR(world->body(robot).pose.x, 1.5, 1e-4);
  EXPECT_EQ(world->body(other).pose, (Pose{2, 0, 0}));
}

TEST(WorldChanges, NameTheObstacleAndChangeNothing) {
  const auto world = make_kinematic_world(two_and_a_wall(), 1);
  EXPECT_EQ(world->move_body(robot, {4.8, 0, 0}), "wall");
  EXPECT_EQ(world->move_body(robot, {0.2, 3.2, 0}), "other");
  EXPECT_EQ(world->body(robot).pose, (Pose{0, 0, 0}));
  EXPECT_EQ(world->put_obstacle({"crate", box({0.3, 0, 0}, 0.5, 0.5), false}), "robot");
  EXPECT_EQ(world->put_obstacle({"wall", box({0, 3, 0}, 0.5, 0.5), false}), "other");
  EXPECT_EQ(world->description().obstacles.size(), 1u);
  EXPECT_NEAR(ahead_m(*world), 4.9, cast_m);
  EXPECT_EQ(world->move_body(robot, {0.1, 0, 0}), std::nullopt) << "it is not in its own way";
}

TEST(WorldChanges, ObstaclesComeMoveAndGo) {
  const auto world = make_kinematic_world(two_and_a_wall(), 1);
  EXPECT_EQ(world->put_obstacle({"crate", box({2, 0, 0}, 1, 1), false}), std::nullopt);
  EXPECT_NEAR(ahead_m(*world), 1.5, cast_m);
  EXPECT_EQ(world->put_obstacle({"crate", box({3, 0, 0}, 1, 1), false}), std::nullopt);
  EXPECT_NEAR(ahead_m(*world), 2.5, cast_m);
  EXPECT_EQ(world->description().obstacles.size(), 2u) << "one of that name took its place";
  world->command(robot, {10, 0});
  for (int i = 0; i < 100; ++i) world->step();
  EXPECT_NEAR(world->body(robot).pose.x, 2.25, 1e-4) << "bodies run into it";
  EXPECT_TRUE(world->remove_obstacle("crate"));
  EXPECT_FALSE(world->remove_obstacle("crate"));
  EXPECT_NEAR(ahead_m(*world, {2.25, 0}), 2.65, cast_m);
}

TEST(WorldChanges, AResetBringsTheFirstObstaclesBack) {
  const auto world = make_kinematic_world(two_and_a_wall(), 1);
  EXPECT_TRUE(world->remove_obstacle("wall"));
  EXPECT_EQ(world->move_body(robot, {7, 0, 0}), std::nullopt);
  world->reset(1);
  EXPECT_EQ(world->description().obstacles.size(), 1u);
  EXPECT_EQ(world->body(robot).pose, (Pose{0, 0, 0}));
  EXPECT_NEAR(ahead_m(*world), 4.9, cast_m);
}

TEST(WorldChanges, SonarsHearTheCornerOfANewObstacle) {
  WorldDescription description = two_and_a_wall();
  description.bodies[0].sensors<Sonars>().emplace_back();
  const auto world = make_kinematic_world(description, 1);
  std::vector<double> range_m;
  fire(*world, robot, 0, 1, range_m);
  EXPECT_EQ(range_m[0], 3) << "nothing is near";
  EXPECT_EQ(world->put_obstacle({"crate", box({2, 0, 0}, 1, 1), false}), std::nullopt);
  fire(*world, robot, 0, 1, range_m);
  EXPECT_NEAR(range_m[0], 1.25, 0.1);
}

}  // namespace
}  // namespace waitpoint::world
