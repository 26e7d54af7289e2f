// SPDX-License-Identifier: BSD-3-Clause
// Robots in a dynamic world: on free floor they move as in the kinematic world, walls stop their wheels, light shapes
// give way.
#include <cmath>

#include "tests/world/bullet/worlds.hpp"
#include "world/kinematic/kinematic_world.hpp"

namespace waitpoint::world {
namespace {

using Driving = DynamicWorldTest;
using Kind = BaseDescription::Kind;

TEST_F(Driving, OnAFreeFloorIsThatOfTheKinematicWorld) {
  for (const Kind kind :
       {Kind::synchro, Kind::differential, Kind::skid_steer, Kind::ackermann, Kind::omni, Kind::aerial}) {
    BodyDescription body = robot("r", {1, 2, 0.3});
    body.base.kind = kind;
    if (kind == Kind::ackermann) body.shape = box({0.25, 0, 0}, 0.8, 0.5);  // the origin is above the rear axle
    description_.bodies = {body};
    start();
    const auto kinematic = make_kinematic_world(description_, 1);
    for (int k = 0; k < 600; ++k) {
      const Velocity wanted = {k < 400 ? 0.6 : 0, k % 200 < 100 ? 0.8 : -0.5, 0.2, k < 300 ? 0.3 : -0.5};
      for (World* world : {world_.get(), kinematic.get()}) {
        world->command(BodyId(0), wanted);
        world->step();
      }
    }
    const BodyState &a = world_->body(BodyId(0)), &b = kinematic->body(BodyId(0));
    const double tolerance = 1e-6;
    EXPECT_NEAR(a.pose.x, b.pose.x, tolerance) << static_cast<int>(kind);
    EXPECT_NEAR(a.pose.y, b.pose.y, tolerance) << static_cast<int>(kind);
    EXPECT_NEAR(a.pose.heading, b.pose.heading, tolerance) << static_cast<int>(kind);
    EXPECT_NEAR(a.height_m, b.height_m, 1e-6) << static_cast<int>(kind);
    EXPECT_NEAR(static_cast<double>(world_->odometer(BodyId(0)).travel_units),
                static_cast<double>(kinematic->odometer(BodyId(0)).travel_units), 2);
    EXPECT_EQ(a.collisions, 0u);
  }
}

TEST_F(Driving, APrismIsHeldWhereItsNoseMeetsAWall) {
  BodyDescription body = robot("r", {0, 0, 0});
  body.shape = prism({0, 0, 0}, {{0.4, 0}, {0.1, 0.3}, {-0.3, 0.2}, {-0.3, -0.2}, {0.1, -0.3}});
  description_.bodies = {body};
  description_.obstacles = {wall({1.6, 0, 0}, 0.2, 4)};
  start();
  world_->command(BodyId(0), {0.8, 0});
  run(3);
  EXPECT_NEAR(this->body().pose.x, 1.1, 0.005);
  EXPECT_TRUE(this->body().stalled);
  EXPECT_NEAR(this->body().pose.heading, 0, 1e-3);
}

TEST_F(Driving, IsHeldByAWallAndTheWheelsStand) {
  BodyDescription body = robot("r", {0, 0, 0});
  body.sensors<Bumpers>().emplace();
  description_.bodies = {body};
  description_.obstacles = {wall({1.6, 0, 0}, 0.2, 4)};
  start();
  world_->command(BodyId(0), {0.8, 0});
  run(3);
  EXPECT_NEAR(this->body().pose.x, 1.25, 0.002);
  EXPECT_TRUE(this->body().stalled);
  EXPECT_EQ(this->body().collisions, 1u);
  EXPECT_EQ(reading<Bumpers>(*world_).pressed, 1u) << "the panel in front";
  const auto counted = world_->odometer(BodyId(0)).travel_units;
  EXPECT_NEAR(static_cast<double>(counted) / body.base.odometry.units_per_m, this->body().pose.x, 1e-4);
  run(5);
  EXPECT_NEAR(static_cast<double>(world_->odometer(BodyId(0)).travel_units), static_cast<double>(counted), 103)
      << "a millimetre at most";
  EXPECT_EQ(this->body().collisions, 1u) << "it is the same one all the time";
  world_->command(BodyId(0), {-0.4, 0});
  run(1);
  EXPECT_FALSE(this->body().stalled);
  EXPECT_LT(this->body().pose.x, 1.1);
}

TEST_F(Driving, PushesALightBoxAheadAndItsRangesAreThoseOfTheMovedBox) {
  BodyDescription body = robot("r", {0, 0, 0});
  body.sensors<Lasers>().push_back(perfect_laser(0.3));
  BodyDescription watcher = robot("watcher", {6, 0, exact::pi});
  description_.bodies = {body, watcher};
  description_.obstacles = {loose_box("box", {1, 0, 0}, 5)};
  start();
  world_->command(BodyId(0), {0.5, 0});
  run(4);
  EXPECT_GT(this->body().pose.x, 1.4);
  EXPECT_NEAR(this->body().velocity.v_m_s, 0.5, 1e-3);
  EXPECT_FALSE(this->body().stalled);
  EXPECT_EQ(this->body().collisions, 0u);
  const Shape before = obstacle(0);
  EXPECT_NEAR(before.pose.x - 0.3, this->body().pose.x + 0.25, 0.005) << "it is in touch";
  world_->step();  // others see it as published a step before
  const double seen_m = world_->cast({{6, 0}, exact::pi, 0.3}, 10, BodyId(1));
  EXPECT_NEAR(6 - seen_m, before.pose.x + 0.5 * before.length_m, 0.002);
  EXPECT_NEAR(6 - world_->cast({{6, 0}, exact::pi, 0.7}, 10, BodyId(1)), this->body().pose.x + 0.25, 0.01)
      << "above it the robot is seen";
}

// 50 kg with 0.5 m/s2 are 50 N at most; the box needs 0.5 x 100 x 9.81.
TEST_F(Driving, AWeakRobotDoesNotMoveAHeavyBox) {
  BodyDescription body = robot("r", {0, 0, 0});
  body.base.v_acceleration_m_s2 = 0.5;
  description_.bodies = {body};
  description_.obstacles = {loose_box("box", {1.2, 0, 0}, 100, 0.5)};
  start();
  world_->command(BodyId(0), {0.3, 0});
  run(6);
  EXPECT_NEAR(obstacle(0).pose.x, 1.2, 0.02) << "but for the blow";
  EXPECT_TRUE(this->body().stalled);
  const double x = obstacle(0).pose.x;
  run(5);
  EXPECT_NEAR(obstacle(0).pose.x, x, 1e-3);
}

// On ice F / (m + M). Friction takes less than that of the whole weight: the robot's hull, which the box rubs against,
// carries some of it.
TEST_F(Driving, PushesWithWhatForceItHas) {
  const auto acceleration = [this](double friction) {
    BodyDescription body = robot("r", {0, 0, 0});
    body.base.drive_force_n = 60;
    description_.bodies = {body};
    description_.obstacles = {loose_box("box", {0.56, 0, 0}, 40, friction)};  // a centimetre ahead
    start();
    world_->command(BodyId(0), {0.9, 0});
    run(0.5);
    const double v = this->body().velocity.v_m_s;
    run(0.5);
    return (this->body().velocity.v_m_s - v) / 0.5;
  };
  const double on_ice = 60.0 / (50 + 40);
  EXPECT_NEAR(acceleration(0), on_ice, 0.02 * on_ice);
  const double friction = 0.1 * 40 * g_m_s2 / (50 + 40), rubbing = acceleration(0.1);
  EXPECT_LT(rubbing, on_ice - 0.85 * friction);
  EXPECT_GT(rubbing, on_ice - 1.01 * friction);
}

TEST_F(Driving, WheelsGiveWaySidewaysBeyondTheirGripAndDoNotCountIt) {
  description_.bodies = {robot("r", {0, 0, 0})};
  start();
  const double grip_n = 0.8 * 50 * g_m_s2;
  world_->push("r", {0, 0.9 * grip_n}, std::chrono::seconds(1));
  run(1);
  EXPECT_NEAR(body().pose.y, 0, 1e-6) << "they hold";
  world_->push("r", {0, 1.5 * grip_n}, std::chrono::milliseconds(500));
  run(0.5);
  EXPECT_NEAR(body().pose.y, 0.5 * 0.5 * 0.8 * g_m_s2 * 0.25, 0.02) << "half the grip is left over";
  run(2);
  EXPECT_NEAR(body().velocity.side_m_s, 0, 1e-6);
  EXPECT_EQ(world_->odometer(BodyId(0)).side_units, 0);
  EXPECT_EQ(world_->odometer(BodyId(0)).travel_units, 0);
}

TEST_F(Driving, AtACoarseStepMeetsTheWallToo) {
  description_.step = std::chrono::milliseconds(500);
  BodyDescription body = robot("r", {0, 0, 0});
  body.base.v_max_m_s = 3;
  description_.bodies = {body};
  description_.obstacles = {wall({4, 0, 0}, 0.05, 4)};
  start();
  world_->command(BodyId(0), {3, 0});
  run(10);
  EXPECT_NEAR(this->body().pose.x, 4 - 0.025 - 0.25, 0.005);
  EXPECT_TRUE(this->body().stalled);
}

TEST_F(Driving, RobotsHoldEachOther) {
  description_.bodies = {robot("a", {0, 0, 0}), robot("b", {2, 0, exact::pi})};
  start();
  for (const BodyId id : {BodyId(0), BodyId(1)}) world_->command(id, {0.5, 0});
  run(5);
  EXPECT_NEAR(world_->body(BodyId(0)).pose.x, 0.75, 0.005);
  EXPECT_NEAR(world_->body(BodyId(1)).pose.x, 1.25, 0.005);
  EXPECT_TRUE(world_->body(BodyId(0)).stalled && world_->body(BodyId(1)).stalled);
}

}  // namespace
}  // namespace waitpoint::world
