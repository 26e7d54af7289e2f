// SPDX-License-Identifier: BSD-3-Clause
// The order within a step and the guarantees of a world, on the FCL engine.
#include "world/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "tests/world/scenes.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

const Shape disc = cylinder({0, 0}, 0.25);

WorldDescription wall_ahead() {
  WorldDescription description;
  description.obstacles.push_back({"wall", box({2.0005, 0, 0}, 0.001, 10), true});
  description.bodies.push_back(nimble_body("robot", disc, {0, 0, 0}));
  return description;
}

TEST(World, VelocityIsLatchedAtTheNextStepAndHeldUntilAnother) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", disc, {0, 0, 0}));
  const auto world = make_kinematic_world(description, 1);
  const BodyId robot{0};
  world->command(robot, {5, 0});
  world->command(robot, {1, 0});
  EXPECT_EQ(world->body(robot).pose, (Pose{0, 0, 0}));
  world->step();
  EXPECT_NEAR(world->body(robot).pose.x, 0.01, 1e-15);
  EXPECT_EQ(world->body(robot).velocity, (Velocity{1, 0}));
  world->step();
  EXPECT_NEAR(world->body(robot).pose.x, 0.02, 1e-15);
  EXPECT_NEAR(world->body(robot).travelled_m, 0.02, 1e-15);
  EXPECT_EQ(world->steps(), 2u);
}

TEST(World, AccelerationIsLimited) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", disc, {0, 0, 0}));
  description.bodies[0].base = {};
  const auto world = make_kinematic_world(description, 1);
  world->command(BodyId(0), {10, -10});
  world->step();
  EXPECT_NEAR(world->body(BodyId(0)).velocity.v_m_s, 0.01, 1e-15);
  EXPECT_NEAR(world->body(BodyId(0)).velocity.w_rad_s, -0.03, 1e-15);
  for (int i = 0; i < 200; ++i) world->step();
  EXPECT_EQ(world->body(BodyId(0)).velocity, (Velocity{0.9, -1.5}));
}

TEST(World, TheArcOfAStepJoinsItsPoses) {
  const auto world = make_kinematic_world(wall_ahead(), 1);
  Draws draw(3);
  for (int i = 0; i < 200; ++i) {
    const Pose before = world->body(BodyId(0)).pose;
    world->command(BodyId(0), {draw(-3, 4), draw(-5, 5)});
    world->step();
    EXPECT_EQ(world->body(BodyId(0)).arc.start, before);
    EXPECT_EQ(world->body(BodyId(0)).arc.end(), world->body(BodyId(0)).pose);
  }
}

TEST(World, NoSpeedPassesAWallThinnerThanAStep) {
  for (const double speed : {0.5, 30.0, 1000.0, 1e5}) {
    const auto world = make_kinematic_world(wall_ahead(), 1);
    world->command(BodyId(0), {speed, 0});
    for (int i = 0; i < 600; ++i) world->step();
    EXPECT_NEAR(world->body(BodyId(0)).pose.x, 1.75 - 1e-6, 1e-8) << speed;
    EXPECT_TRUE(world->body(BodyId(0)).stalled);
    EXPECT_EQ(world->body(BodyId(0)).collisions, 1u) << "pushing on is one collision";
    EXPECT_EQ(world->body(BodyId(0)).velocity, (Velocity{}));
  }
}

TEST(World, LeavingAWallFreesAndMeetingItAgainIsAnotherCollision) {
  const auto world = make_kinematic_world(wall_ahead(), 1);
  const BodyState& robot = world->body(BodyId(0));
  for (std::uint64_t round = 1; round <= 3; ++round) {
    world->command(BodyId(0), {3, 0});
    for (int i = 0; i < 100; ++i) world->step();
    EXPECT_TRUE(robot.stalled);
    EXPECT_EQ(robot.collisions, round);
    world->command(BodyId(0), {0, 0});
    world->step();
    EXPECT_TRUE(robot.stalled) << "standing still frees nobody";
    const double x = robot.pose.x;
    world->command(BodyId(0), {-3, 0});
    world->step();
    EXPECT_FALSE(robot.stalled);
    EXPECT_NEAR(robot.pose.x, x - 0.03, 1e-11) << "free at once";
  }
}

TEST(World, BodiesPassUnderWhatIsAboveThem) {
  WorldDescription description = wall_ahead();
  description.obstacles[0].shape.z_low_m = 1;
  description.obstacles[0].shape.z_high_m = 2;
  const auto world = make_kinematic_world(description, 1);
  world->command(BodyId(0), {10, 0});
  for (int i = 0; i < 100; ++i) world->step();
  EXPECT_NEAR(world->body(BodyId(0)).pose.x, 10, 1e-9);
}

// Runs robots that drive at each other in every order and with every naming; each must behave as in the first run.
void expect_same_under_every_naming(const std::vector<BodyDescription>& bodies, const std::vector<Velocity>& commands,
                                    std::uint64_t collisions) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<BodyState> expected;
  do {
    WorldDescription description;
    for (const std::size_t i : order) {
      description.bodies.push_back(bodies[i]);
      description.bodies.back().name = numbered("n", description.bodies.size());
    }
    const auto world = make_kinematic_world(description, 1);
    for (std::size_t k = 0; k < order.size(); ++k) world->command(BodyId(k), commands[order[k]]);
    std::vector<BodyState> states(order.size());
    std::uint64_t counted = 0;
    for (int step = 0; step < 60; ++step) {
      world->step();
      for (std::size_t k = 0; k < order.size(); ++k) {
        for (std::size_t l = 0; l < k; ++l) {
          const double gap = separation(outline_of(description.bodies[k].shape, world->body(BodyId(k)).pose),
                                        outline_of(description.bodies[l].shape, world->body(BodyId(l)).pose))
                                 .distance_m;
          ASSERT_GT(gap, 0.49e-6);
        }
      }
    }
    for (std::size_t k = 0; k < order.size(); ++k) {
      states[order[k]] = world->body(BodyId(k));
      counted += states[order[k]].collisions;
    }
    EXPECT_EQ(counted, collisions);
    if (expected.empty()) expected = states;
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_EQ(states[i].pose, expected[i].pose);
      EXPECT_EQ(states[i].collisions, expected[i].collisions);
      EXPECT_EQ(states[i].travelled_m, expected[i].travelled_m);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(World, HeadOnAtTenMetresASecond) {
  expect_same_under_every_naming({nimble_body("", disc, {-2.03, 0, 0}), nimble_body("", disc, {2, 0.01, exact::pi})},
                                 {{10, 0}, {10, 0}}, 2);
}

TEST(World, Crossing) {
  expect_same_under_every_naming(
      {nimble_body("", disc, {-2, 0, 0}), nimble_body("", box({0.1, 0, 0}, 0.8, 0.5), {0.2, -2, 0.5 * exact::pi})},
      {{10, 0.2}, {10, -0.3}}, 2);
}

TEST(World, ThreeAtOnce) {
  std::vector<BodyDescription> bodies;
  for (int k = 0; k < 3; ++k) {
    const double direction = 2 * exact::pi * k / 3;
    const auto [s, c] = exact::sincos(direction);
    bodies.push_back(nimble_body("", disc, {-2 * c, -2 * s, direction}));
  }
  expect_same_under_every_naming(bodies, {{10, 0}, {10, 0}, {10, 0}}, 3);
}

TEST(World, ABodyFarAwayChangesNothing) {
  const auto run = [](bool with_stranger) {
    WorldDescription description = wall_ahead();
    description.bodies[0].sensors<Lasers>().push_back({});
    description.bodies[0].base.odometry.travel_noise_m_per_sqrt_m = 0.01;
    if (with_stranger) {
      description.bodies.insert(description.bodies.begin(), nimble_body("stranger", disc, {500, 0, 0}));
    }
    const auto world = make_kinematic_world(description, 5);
    const BodyId robot{with_stranger ? 1u : 0u};
    if (with_stranger) world->command(BodyId(0), {300, 2});
    Digest digest;
    LaserScan scan;
    for (std::uint64_t i = 0; i < 100; ++i) {
      world->command(robot, {2, 0.1});
      world->step();
      world->scan(robot, 0, i, scan);
      add_value(digest, world->body(robot));
      add_value(digest, world->odometer(robot));
      for (const double range : scan.range_m) digest.add(range);
    }
    return digest;
  };
  EXPECT_EQ(run(false), run(true));
}

TEST(World, NeighboursAreSeenWhereTheyWereAStepAgo) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("seer", disc, {0, 0, 0}));
  description.bodies.push_back(nimble_body("seen", box({0, 0, 0}, 1, 1), {3, 0, 0}));
  description.bodies[0].sensors<Lasers>().push_back(perfect_laser(0.4));
  const auto world = make_kinematic_world(description, 1);
  LaserScan scan;
  const auto ahead = [&] {
    world->scan(BodyId(0), 0, 1, scan);
    return scan.range_m[180];
  };
  EXPECT_NEAR(ahead(), 2.5, 1e-11);
  world->command(BodyId(0), {10, 0});
  world->command(BodyId(1), {10, 0});
  world->step();
  EXPECT_NEAR(ahead(), 2.4, 1e-11) << "its own body is where it is now";
  world->step();
  EXPECT_NEAR(ahead(), 2.4, 1e-11);
  world->command(BodyId(1), {0, 0});
  world->step();
  EXPECT_NEAR(ahead(), 2.4, 1e-11);
  world->step();
  EXPECT_NEAR(ahead(), 2.3, 1e-11) << "the other stood still for the last step";
  EXPECT_NEAR(world->cast({{0, 0}, 0, 0.4}, 30, BodyId(0)), 2.7, 1e-11);
  EXPECT_LT(world->cast({{0, 0}, 0, 0.4}, 30), 0.3) << "the seer itself is in the way of a beam of nobody's";
  EXPECT_EQ(world->cast({{0, 0}, 0.5 * exact::pi, 0.4}, 30), 30);
  EXPECT_EQ(world->cast({{0, 0}, 0, 1.5}, 30), 30) << "over their heads";
}

TEST(World, ResetRunsTheSameAgainAndAnotherSeedDrawsOtherNoise) {
  WorldDescription description = wall_ahead();
  description.bodies[0].sensors<Lasers>().push_back({});
  description.bodies[0].sensors<Sonars>().push_back({});
  description.bodies[0].base.odometry.turn_noise_rad_per_sqrt_m = 0.02;
  const auto world = make_kinematic_world(description, 1);
  const auto run = [&] {
    Digest digest;
    LaserScan scan;
    std::vector<double> sonar;
    for (std::uint64_t i = 0; i < 120; ++i) {
      world->command(BodyId(0), {2, 0.3});
      world->step();
      world->scan(BodyId(0), 0, i, scan);
      fire(*world, BodyId(0), 0, i, sonar);
      for (const double range : scan.range_m) digest.add(range);
      for (const double range : sonar) digest.add(range);
      add_value(digest, world->body(BodyId(0)));
      add_value(digest, world->odometer(BodyId(0)));
      digest.add(reading<Battery>(*world).volts);
    }
    return digest;
  };
  const Digest first = run();
  world->reset(1);
  EXPECT_EQ(world->steps(), 0u);
  EXPECT_EQ(world->body(BodyId(0)).pose, (Pose{0, 0, 0}));
  EXPECT_EQ(run(), first);
  world->reset(2);
  EXPECT_NE(run(), first);
}

/// All readings of a body with every device whose errors have no state of the start.
Digest noisy_readings(std::uint64_t seed, std::optional<std::uint64_t> other) {
  WorldDescription description = wall_ahead();
  BodyDescription& body = description.bodies[0];
  body.sensors<Lasers>().emplace_back();
  body.sensors<Lasers>()[0].angle_noise_rad = 0.001;
  body.sensors<Lasers>()[0].dropout = 0.1;
  body.sensors<Sonars>().push_back({});
  SensorsWithModel::for_each([&]<class S>() { body.sensors<S>().emplace(); });
  for (InertialErrors* errors : {&body.sensors<Imu>()->gyro, &body.sensors<Imu>()->accelerometer})
    errors->noise_per_sqrt_hz = errors->walk_per_sqrt_s = 0.01;
  body.sensors<Gps>()->noise_m = 0.3;
  body.sensors<Gps>()->dropout = 0.2;
  body.sensors<Gps>()->period = std::chrono::milliseconds(50);
  body.base.odometry.turn_noise_rad_per_sqrt_m = body.base.odometry.wheel_noise_m_per_sqrt_m = 0.02;
  body.base.odometry.slips_per_m = 5;
  const auto world = make_kinematic_world(description, seed);
  if (other) world->reseed(*other);
  Digest digest;
  LaserScan scan;
  std::vector<double> ranges;
  for (std::uint64_t i = 0; i < 60; ++i) {
    world->command(BodyId(0), {2, 0.3});
    world->step();
    world->scan(BodyId(0), 0, i, scan);
    fire(*world, BodyId(0), 0, i, ranges);
    for (const std::vector<double>* values : {&scan.range_m, &ranges})
      for (const double value : *values) digest.add(value);
    SensorsWithModel::for_each([&]<class S>() { add_value(digest, reading<S>(*world, BodyId(0), i)); });
    add_value(digest, world->odometer(BodyId(0)));
  }
  return digest;
}

TEST(World, AllErrorsAreDrawnAsWithAnotherSeedFromAnInstantOn) {
  EXPECT_EQ(noisy_readings(1, 2), noisy_readings(2, {}));
  EXPECT_NE(noisy_readings(1, 2), noisy_readings(1, {}));
}

TEST(World, StartsThatOverlapAreNamed) {
  WorldDescription description = wall_ahead();
  EXPECT_TRUE(start_overlaps(description).empty());
  description.bodies.push_back(nimble_body("second", disc, {0.4, 0.2, 0}));
  description.bodies.push_back(nimble_body("third", disc, {1.9, -2, 0}));
  const std::vector<StartOverlap> overlaps = start_overlaps(description);
  ASSERT_EQ(overlaps.size(), 2u);
  EXPECT_EQ(overlaps[0].body, "second");
  EXPECT_EQ(overlaps[0].other, "robot");
  EXPECT_TRUE(overlaps[0].other_is_body);
  EXPECT_EQ(overlaps[1].body, "third");
  EXPECT_EQ(overlaps[1].other, "wall");
  EXPECT_FALSE(overlaps[1].other_is_body);
}

TEST(WorldDeathTest, ACommandOfNaNIsABug) {
  const auto world = make_kinematic_world(wall_ahead(), 1);
  EXPECT_DEATH(world->command(BodyId(0), {0.0 / 0.0, 0}), "NaN");
}

}  // namespace
}  // namespace waitpoint::world
