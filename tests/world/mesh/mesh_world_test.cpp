// SPDX-License-Identifier: BSD-3-Clause
// Bodies among meshes: their contacts, and invalid initial poses.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/meshes.hpp"
#include "world/bullet/bullet_world.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/mesh/surfaces.hpp"

namespace waitpoint::world {
namespace {

constexpr BodyId only{0};

WorldDescription world_of(TriangleMesh mesh, const BodyDescription& body) {
  WorldDescription description;
  description.meshes = {mesh_obstacle("mesh", std::move(mesh))};
  description.bodies = {body};
  return description;
}

BodyDescription disc(const Pose& start) { return nimble_body("disc", cylinder({0, 0}, 0.25), start); }

BodyDescription flyer(const Pose& start, double height_m) {
  BodyDescription body = disc(start);
  body.shape.z_high_m = 0.2;
  body.start_height_m = height_m;
  body.base.kind = BaseDescription::Kind::aerial;
  body.base.climb_max_m_s = 1e3;
  body.base.climb_acceleration_m_s2 = 1e9;
  return body;
}

// x ahead of a plane that rises by one in `slope`: z = (x - 2) / slope, two metres to each side.
TriangleMesh ramp(double slope) {
  TriangleMesh mesh;
  add_quad(mesh, {2, -2, 0}, {2 + 3 * slope, -2, 3}, {2 + 3 * slope, 2, 3}, {2, 2, 0});
  return mesh;
}

TEST(MeshWorld, ABodyStopsAMicrometreBeforeAWallAtAnySpeed) {
  for (const double speed_m_s : {0.5, 40.0, 10'000.0}) {
    const auto world = make_kinematic_world(world_of(box_mesh({3, -1, 0}, {4, 1, 2}), disc({})), 1);
    world->command(only, {speed_m_s, 0});
    for (int step = 0; step < 1000 && world->body(only).collisions == 0; ++step) world->step();
    EXPECT_EQ(world->body(only).collisions, 1u);
    EXPECT_NEAR(world->body(only).pose.x, 2.75 - 1e-6, 2e-9) << speed_m_s;
  }
}

TEST(MeshWorld, ASlopeIsMetAtTheFloorForItIsHighestBehind) {
  const auto world = make_kinematic_world(world_of(ramp(1), disc({})), 1);
  world->command(only, {5, 0});
  for (int step = 0; step < 100; ++step) world->step();
  EXPECT_NEAR(world->body(only).pose.x, 1.75 - 1e-6, 2e-9);
}

TEST(MeshWorld, AnOverhangIsMetAtTheBodysHeight) {
  // It descends from 3 m at x = 2 to the floor at x = 5: at the body's upper face, 1 m, it is at x = 4.
  TriangleMesh mesh;
  add_quad(mesh, {2, -2, 3}, {5, -2, 0}, {5, 2, 0}, {2, 2, 3});
  const auto world = make_kinematic_world(world_of(mesh, disc({})), 1);
  world->command(only, {5, 0});
  for (int step = 0; step < 200; ++step) world->step();
  EXPECT_NEAR(world->body(only).pose.x, 3.75 - 1e-6, 2e-9);
}

TEST(MeshWorld, IgnoresSurfacesAboveAndInsideABody) {
  // A hall with its floor and ceiling, and a table top above the body.
  TriangleMesh mesh = box_mesh({-10, -10, 0}, {10, 10, 3});
  add_quad(mesh, {1, -1, 1}, {3, -1, 1}, {3, 1, 1}, {1, 1, 1});
  const auto world = make_kinematic_world(world_of(mesh, disc({})), 1);
  world->command(only, {5, 0});
  for (int step = 0; step < 400; ++step) world->step();
  EXPECT_NEAR(world->body(only).pose.x, 9.75 - 1e-6, 2e-9);
}

TEST(MeshWorld, ADescendingBodyStandsOnASlopeAndLeavesItAgain) {
  for (const double speed_m_s : {0.3, 500.0}) {
    // Over x = 5 the ramp is 3 m high, minus the reach of the disc to the back: its rim is over 3.25.
    const auto world = make_kinematic_world(world_of(ramp(1), flyer({4, 0, 0}, 5)), 1);
    world->command(only, {0, 0, 0, -speed_m_s});
    for (int step = 0; step < 1000; ++step) world->step();
    const double touches_m = 4 + 0.25 - 2;
    EXPECT_GE(world->body(only).height_m, touches_m);
    EXPECT_LE(world->body(only).height_m, touches_m + 2e-6);
    EXPECT_GE(world->body(only).collisions, 1u);
    world->command(only, {0, 0, 0, 0.5});
    for (int step = 0; step < 100; ++step) world->step();
    EXPECT_NEAR(world->body(only).height_m, touches_m + 0.5, 1e-5);
    EXPECT_FALSE(world->body(only).stalled);
  }
}

TEST(MeshWorld, AClimbingBodyNeverGetsThroughTriangles) {
  Draws draw(7);
  int collisions = 0;
  for (int k = 0; k < 200; ++k) {
    const TriangleMesh mesh = random_triangles(draw, 25, 3, 1, 3);
    WorldDescription description = world_of(mesh, flyer({draw(-3, 3), draw(-3, 3), 0}, draw(0, 3)));
    if (!start_overlaps(description).empty()) continue;
    const Surfaces surfaces(description.meshes);
    const auto world = make_kinematic_world(description, 1);
    for (int step = 0; step < 60; ++step) {
      world->command(only, {draw(-20, 20), draw(-2, 2), 0, draw(-20, 20)});
      world->step();
      const BodyState& state = world->body(only);
      const Outline outline = outline_of(description.bodies[0].shape, state.pose);
      for (std::uint32_t i = 0; i < surfaces.size(); ++i)
        ASSERT_GT(surfaces.separation(outline, state.height_m, state.height_m + 0.2, i).distance_m, 0) << k;
    }
    collisions += static_cast<int>(world->body(only).collisions);
  }
  EXPECT_GT(collisions, 100);
}

TEST(MeshWorld, ABodyCannotStartOrBePutWithinReachOfATriangle) {
  WorldDescription description = world_of(box_mesh({3, -1, 0}, {4, 1, 2}), disc({2.9, 0, 0}));
  ASSERT_EQ(start_overlaps(description).size(), 1u);
  EXPECT_EQ(start_overlaps(description)[0].other, "mesh");
  EXPECT_FALSE(start_overlaps(description)[0].other_is_body);
  description.bodies[0].start = {};
  ASSERT_TRUE(start_overlaps(description).empty());
  const auto world = make_kinematic_world(description, 1);
  EXPECT_EQ(world->move_body(only, {2.8, 0, 0}), "mesh");
  EXPECT_EQ(world->move_body(only, {2.7, 0, 0}), std::nullopt);
}

TEST(MeshWorld, SensorsSeeIt) {
  for (const Engine engine : {Engine::fcl, Engine::slice}) {
    BodyDescription body = disc({2.75 - 1e-4, 0, 0});
    body.sensors<Lasers>() = {perfect_laser(0.5)};
    body.sensors<Sonars>().emplace_back();
    body.sensors<Sonars>()[0].range_noise_relative = 0;
    body.sensors<Bumpers>().emplace();
    WorldDescription description = world_of(box_mesh({3, -1, 0}, {4, 1, 2}), body);
    description.engine = engine;
    const auto world = make_kinematic_world(description, 1);
    EXPECT_EQ(reading<Bumpers>(*world, only).pressed & 1u, 1u);
    EXPECT_EQ(world->move_body(only, {1, 0, 0}), std::nullopt);
    EXPECT_EQ(reading<Bumpers>(*world, only).pressed, 0u);
    LaserScan scan;
    world->scan(only, 0, 1, scan);
    EXPECT_NEAR(scan.range_m[180], 2, 1e-11);
    EXPECT_NEAR(world->cast({{1, 0}, 0, 0.7}, 10, only), 2, 1e-11) << "at a height without a sensor";
    EXPECT_EQ(world->cast({{1, 0}, 0, 2.1}, 10), 10);
    std::vector<double> ranges;
    fire(*world, only, 0, 1, ranges);
    EXPECT_NEAR(ranges[0], 1.75, 1e-9);
    EXPECT_EQ(ranges[6], body.sensors<Sonars>()[0].range_max_m);
  }
}

TEST(MeshWorld, HoldsADrivenBodyInAWorldOfForces) {
  BodyDescription body = disc({});
  body.base = {};
  // A hall with its floor, so that wheels roll on a mesh.
  const WorldDescription description = world_of(box_mesh({-3, -3, 0}, {3, 3, 2}), body);
  const auto world = make_bullet_world(description, 1);
  if (world == nullptr) GTEST_SKIP() << "without Bullet";
  world->command(only, {0.9, 0});
  for (int step = 0; step < 600; ++step) world->step();
  EXPECT_NEAR(world->body(only).pose.x, 2.75, 0.02);
  EXPECT_NEAR(world->body(only).pose.y, 0, 0.02);
  EXPECT_TRUE(world->body(only).stalled);
  EXPECT_EQ(world->move_body(only, {2.9, 0, 0}), "mesh");
}

}  // namespace
}  // namespace waitpoint::world
