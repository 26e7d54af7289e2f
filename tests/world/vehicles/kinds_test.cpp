// SPDX-License-Identifier: BSD-3-Clause
// Each kind of vehicle, driven in a small world, against its closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"
#include "world/vehicles/ackermann.hpp"
#include "world/vehicles/base.hpp"

namespace waitpoint::world {
namespace {

using Kind = BaseDescription::Kind;
const BodyId robot{0};
constexpr double step_s = 0.01;

BodyDescription body_on(Kind kind) {
  BodyDescription body = nimble_body("robot", cylinder({0, 0}, 0.25), {0, 0, 0});
  body.base.kind = kind;
  body.base.steering_rate_rad_s = 1e9;
  body.base.climb_max_m_s = 1e5;
  body.base.climb_acceleration_m_s2 = 1e9;
  return body;
}

std::unique_ptr<VehicleWorld> world_of(const BodyDescription& body) {
  WorldDescription description;
  description.bodies.push_back(body);
  return make_kinematic_world(description, 1);
}

void drive(World& world, const Velocity& velocity, int steps) {
  world.command(robot, velocity);
  for (int i = 0; i < steps; ++i) world.step();
}

// --- omni ----------------------------------------------------------------------------------------------------------

TEST(OmniBase, DrivesASquareWithoutTurning) {
  const auto world = world_of(body_on(Kind::omni));
  const double side_m = 2;
  const Point corners[] = {{side_m, 0}, {side_m, side_m}, {0, side_m}, {0, 0}};
  const Velocity legs[] = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
  for (int i = 0; i < 4; ++i) {
    drive(*world, legs[i], 200);
    EXPECT_NEAR(length(world->body(robot).pose.position() - corners[i]), 0, 1e-12);
    EXPECT_EQ(world->body(robot).pose.heading, 0);
  }
  EXPECT_NEAR(world->body(robot).travelled_m, 4 * side_m, 1e-12);
}

// At constant (v, side, w) every point of a body moves about (-side, v) / w.
TEST(OmniBase, GoesRoundACircleThatItDoesNotFace) {
  const auto world = world_of(body_on(Kind::omni));
  const Velocity velocity = {0.3, 0.5, -0.4};
  const Point centre = {-velocity.side_m_s / velocity.w_rad_s, velocity.v_m_s / velocity.w_rad_s};
  for (int i = 0; i < 500; ++i) {
    drive(*world, velocity, 1);
    EXPECT_NEAR(length(world->body(robot).pose.position() - centre), 0.5 / 0.5, 1e-12);
  }
  EXPECT_NEAR(world->body(robot).pose.heading, 0.5 * 5, 1e-12);
}

TEST(OmniBase, SpeedAndAccelerationAreThoseOfTheVector) {
  BodyDescription body = body_on(Kind::omni);
  body.base.v_max_m_s = 1;
  body.base.v_acceleration_m_s2 = 2;
  EXPECT_NEAR(limited(body.base, {30, 0, 40}).v_m_s, 0.6, 1e-15);
  EXPECT_NEAR(limited(body.base, {30, 0, 40}).side_m_s, 0.8, 1e-15);
  const auto world = world_of(body);
  drive(*world, {3, 0, 4}, 10);
  EXPECT_NEAR(world->body(robot).velocity.v_m_s, 0.6 * 0.2, 1e-14);
  EXPECT_NEAR(world->body(robot).velocity.side_m_s, 0.8 * 0.2, 1e-14);
}

// --- Ackermann -------------------------------------------------------------------------------------------------------

TEST(AckermannBase, DrivesTheCircleOfItsSteering) {
  BodyDescription body = body_on(Kind::ackermann);
  body.base.wheelbase_m = 1.2;
  body.base.steering_max_rad = 0.5;
  const double tightest_m = 1.2 / std::tan(0.5);
  for (const double radius_m : {tightest_m, 4.0, -7.0}) {
    for (const double v : {0.8, -0.8}) {
      const auto world = world_of(body);
      for (int i = 0; i < 1000; ++i) {
        drive(*world, {v, v / radius_m}, 1);
        ASSERT_NEAR(length(world->body(robot).pose.position() - Point{0, radius_m}), std::fabs(radius_m), 1e-11);
      }
      EXPECT_NEAR(world->body(robot).velocity.w_rad_s, v / radius_m, 1e-14);
    }
  }
}

TEST(AckermannBase, TurnsNoTighterThanItsSteering) {
  BodyDescription body = body_on(Kind::ackermann);
  body.base.wheelbase_m = 1.2;
  body.base.steering_max_rad = 0.5;
  const double tightest_m = 1.2 / std::tan(0.5);
  const auto world = world_of(body);
  drive(*world, {0.5, 3}, 1);
  EXPECT_EQ(world->body(robot).velocity.v_m_s, 0.5);
  EXPECT_NEAR(world->body(robot).velocity.w_rad_s, 0.5 / tightest_m, 1e-14);
  EXPECT_NEAR(limited(body.base, {0.5, 3}).w_rad_s, 0.5 / tightest_m, 1e-14);
}

TEST(AckermannBase, CannotTurnOnTheSpotButSteersForIt) {
  BodyDescription body = body_on(Kind::ackermann);
  const auto world = world_of(body);
  drive(*world, {0, 1}, 100);
  EXPECT_EQ(world->body(robot).pose, (Pose{0, 0, 0}));
  EXPECT_EQ(limited(body.base, {0, 1}), Velocity());
  EXPECT_EQ(next_motion(body.base, {}, {0, 1}, step_s).steering_rad, body.base.steering_max_rad);
  EXPECT_EQ(next_motion(body.base, {{}, 0.2}, {}, step_s).steering_rad, 0.2) << "a stop leaves them";
}

// The heading after a time t of steering at the rate r from straight ahead is the integral of v tan(r t) / L: -v
// ln(cos(r t)) / (L r).
TEST(AckermannBase, SteersAtItsRate) {
  BodyDescription body = body_on(Kind::ackermann);
  body.base.steering_rate_rad_s = 0.4;
  body.base.steering_max_rad = 0.6;
  body.base.wheelbase_m = 0.8;
  const auto world = world_of(body);
  const double v = 1, t = 1.5;
  drive(*world, {v, 1e3 * v}, static_cast<int>(t / step_s));
  const double heading = -v * std::log(std::cos(0.6)) / (0.8 * 0.4);
  const double curvature = std::tan(0.6) / 0.8;
  EXPECT_NEAR(world->body(robot).velocity.w_rad_s, v * curvature, 1e-9) << "at its end after 0.6 / 0.4 s";
  EXPECT_NEAR(world->body(robot).pose.heading, heading, 0.5 * step_s * v * curvature + 1e-4) << "to half a step";
}

// --- skid-steer ------------------------------------------------------------------------------------------------------

TEST(SkidSteerBase, TurnsLessThanItsWheels) {
  BodyDescription body = body_on(Kind::skid_steer);
  body.base.effective_axle_ratio = 1.6;
  body.base.odometry.units_per_m = body.base.odometry.units_per_rad = 1e9;
  const auto world = world_of(body);
  const double radius_m = 0.5 / (0.8 / 1.6);
  for (int i = 0; i < 300; ++i) {
    drive(*world, {0.5, 0.8}, 1);
    ASSERT_NEAR(length(world->body(robot).pose.position() - Point{0, radius_m}), radius_m, 1e-12);
  }
  EXPECT_NEAR(world->body(robot).pose.heading, 3 * 0.8 / 1.6, 1e-12);
  EXPECT_NEAR(static_cast<double>(world->odometer(robot).turn_units) * 1e-9, 3 * 0.8, 1e-8) << "the wheels believe it";
  EXPECT_NEAR(static_cast<double>(world->odometer(robot).travel_units) * 1e-9, 3 * 0.5, 1e-8);
}

TEST(SkidSteerBase, ItsLimitsAreThoseOfItsWheels) {
  BodyDescription body = body_on(Kind::skid_steer);
  body.base.v_max_m_s = 1;
  body.base.axle_m = 0.6;
  body.base.effective_axle_ratio = 2;
  EXPECT_EQ(limited(body.base, {0.7, 1}), (Velocity{0.7, 0.5}));
  EXPECT_NEAR(limited(body.base, {0, 100}).w_rad_s, 1 / 0.3 / 2, 1e-12);
}

// --- aerial ----------------------------------------------------------------------------------------------------------

// Climbing from rest to a height h at acceleration a and climb velocity c takes h / c + c / (2 a).
TEST(AerialBase, ClimbsInTheTimeThatItsLimitsAllow) {
  BodyDescription body = body_on(Kind::aerial);
  body.base.climb_max_m_s = 0.8;
  body.base.climb_acceleration_m_s2 = 1.6;
  const auto world = world_of(body);
  world->command(robot, {0, 0, 0, 5});
  int steps = 0;
  for (; world->body(robot).height_m < 3; ++steps) {
    ASSERT_LT(steps, 10000);
    world->step();
    ASSERT_LE(world->body(robot).velocity.climb_m_s, 0.8);
  }
  EXPECT_NEAR(steps * step_s, 3 / 0.8 + 0.8 / (2 * 1.6), 2 * step_s);
  EXPECT_EQ(world->body(robot).pose, (Pose{0, 0, 0}));
  EXPECT_NEAR(world->body(robot).travelled_m, world->body(robot).height_m, 1e-12);
}

TEST(AerialBase, TheFloorHoldsIt) {
  BodyDescription body = body_on(Kind::aerial);
  body.start_height_m = 1;
  const auto world = world_of(body);
  drive(*world, {0.5, 0, 0, -0.3}, 1000);
  EXPECT_EQ(world->body(robot).height_m, 0);
  EXPECT_EQ(world->body(robot).velocity, (Velocity{0.5, 0})) << "it slides on";
  EXPECT_EQ(world->body(robot).collisions, 0u);
  drive(*world, {0, 0, 0, 0.3}, 100);
  EXPECT_NEAR(world->body(robot).height_m, 0.3, 1e-12) << "and takes off again";
}

TEST(AerialBase, FliesAHelix) {
  const auto world = world_of(body_on(Kind::aerial));
  for (int i = 1; i <= 500; ++i) {
    drive(*world, {0.6, 0.5, 0, 0.2}, 1);
    ASSERT_NEAR(length(world->body(robot).pose.position() - Point{0, 1.2}), 1.2, 1e-12);
    ASSERT_NEAR(world->body(robot).height_m, 0.2 * step_s * i, 1e-12);
  }
}

TEST(AerialBase, SeesWhatIsAtItsHeight) {
  for (const Engine engine : {Engine::fcl, Engine::slice}) {
    WorldDescription description;
    description.engine = engine;
    description.bodies.push_back(body_on(Kind::aerial));
    description.bodies[0].shape.z_high_m = 0.3;
    description.bodies[0].sensors<Lasers>().push_back(perfect_laser(0.2));
    description.bodies.push_back(nimble_body("seer", cylinder({0, 0}, 0.25), {-3, 0, 0}));
    description.bodies[1].sensors<Lasers>().push_back(perfect_laser(0.2));
    description.obstacles.push_back({"desk", box({3, 0, 0}, 1, 4), true});
    description.obstacles[0].shape.z_high_m = 0.75;
    const auto world = make_kinematic_world(description, 1);
    const auto ahead = [&](BodyId id) {
      LaserScan scan;
      world->scan(id, 0, 1, scan);
      return scan.range_m[180];
    };
    EXPECT_NEAR(ahead(robot), 2.5, 1e-11);
    EXPECT_NEAR(ahead(BodyId(1)), 2.75, 1e-11) << "the other sees it on the floor";
    drive(*world, {0, 0, 0, 0.3}, 202);
    EXPECT_EQ(ahead(robot), 32) << "above the desk";
    EXPECT_NEAR(ahead(BodyId(1)), 5.5, 1e-11) << "below it";
    drive(*world, {0, 0, 0, -0.3}, 300);
    EXPECT_NEAR(ahead(robot), 2.5, 1e-11);
    EXPECT_NEAR(ahead(BodyId(1)), 2.75, 1e-11);
  }
}

// --- all -------------------------------------------------------------------------------------------------------------

class EveryBase : public testing::TestWithParam<Kind> {
 protected:
  BaseDescription base() const {
    BaseDescription base;
    base.kind = GetParam();
    base.v_max_m_s = 1;
    base.w_max_rad_s = 1.7;
    base.wheelbase_m = 0.35;  // tight enough for w_max_rad_s to matter
    return base;
  }
};

TEST_P(EveryBase, NeverExceedsItsLimits) {
  const BaseDescription base = this->base();
  Draws draw(1);
  BaseMotion now;
  const double tiny = 1e-12;
  for (int i = 0; i < 20000; ++i) {
    const Velocity wanted = {draw(-2, 2), draw(-4, 4), draw(-2, 2), draw(-1, 1)};
    for (int k = 0; k < 20; ++k) {
      const BaseMotion next = next_motion(base, now, wanted, step_s);
      const Velocity &a = now.velocity, &b = next.velocity;
      ASSERT_LE(exact::hypot(b.v_m_s, b.side_m_s), base.v_max_m_s + tiny);
      ASSERT_LE(std::fabs(b.w_rad_s), base.w_max_rad_s + tiny);
      ASSERT_LE(std::fabs(b.climb_m_s), base.climb_max_m_s + tiny);
      ASSERT_LE(exact::hypot(b.v_m_s - a.v_m_s, b.side_m_s - a.side_m_s), base.v_acceleration_m_s2 * step_s + tiny);
      ASSERT_LE(std::fabs(b.climb_m_s - a.climb_m_s), base.climb_acceleration_m_s2 * step_s + tiny);
      ASSERT_LE(std::fabs(next.steering_rad), base.steering_max_rad + tiny);
      ASSERT_LE(std::fabs(next.steering_rad - now.steering_rad), base.steering_rate_rad_s * step_s + tiny);
      if (base.kind == Kind::ackermann) {
        ASSERT_NEAR(b.w_rad_s, b.v_m_s * curvature_per_m(base, next.steering_rad), tiny);
      } else {
        ASSERT_LE(std::fabs(b.w_rad_s - a.w_rad_s), base.w_acceleration_rad_s2 * step_s + tiny);
      }
      if (base.kind != Kind::omni && base.kind != Kind::aerial) {
        ASSERT_EQ(b.side_m_s, 0);
      }
      if (base.kind != Kind::aerial) {
        ASSERT_EQ(b.climb_m_s, 0);
      }
      now = next;
    }
  }
}

TEST_P(EveryBase, GetsWhereItWasTold) {
  const BaseDescription base = this->base();
  BaseMotion now;
  Draws draw(2);
  for (int i = 0; i < 200; ++i) {
    const Velocity wanted = {draw(-2, 2), draw(-4, 4), draw(-2, 2), draw(-1, 1)};
    for (int k = 0; k < 400; ++k) now = next_motion(base, now, wanted, step_s);
    const Velocity there = limited(base, wanted);
    EXPECT_NEAR(now.velocity.v_m_s, there.v_m_s, 1e-12);
    EXPECT_NEAR(now.velocity.w_rad_s, there.w_rad_s, 1e-12);
    EXPECT_NEAR(now.velocity.side_m_s, there.side_m_s, 1e-12);
    EXPECT_NEAR(now.velocity.climb_m_s, there.climb_m_s, 1e-12);
  }
}

// A command of 0.6 m/s without renewal is in force for 300 ms; braking at 2 m/s2 then takes 0.3 s.
TEST_P(EveryBase, BrakesToStandStillWhenItsWatchdogHearsNothing) {
  BodyDescription body = body_on(GetParam());
  body.base.v_acceleration_m_s2 = 2;
  body.base.watchdog = Duration(std::chrono::milliseconds(300));
  const auto world = world_of(body);
  for (int i = 0; i < 200; ++i) drive(*world, {0.6, 0}, 1);
  EXPECT_EQ(world->body(robot).velocity.v_m_s, 0.6) << "renewed in time";
  for (int i = 0; i < 30; ++i) world->step();
  EXPECT_EQ(world->body(robot).velocity.v_m_s, 0.6);
  world->step();
  EXPECT_NEAR(world->body(robot).velocity.v_m_s, 0.58, 1e-12);
  for (int i = 0; i < 30; ++i) world->step();
  EXPECT_EQ(world->body(robot).velocity, Velocity());
  drive(*world, {0.6, 0}, 10);
  EXPECT_NEAR(world->body(robot).velocity.v_m_s, 0.2, 1e-12) << "until it hears again";
}

TEST_P(EveryBase, NoSpeedPassesAWallThinnerThanAStep) {
  for (const double speed : {0.5, 30.0, 1000.0, 1e5}) {
    WorldDescription description;
    description.obstacles.push_back({"wall", box({2.0005, 0, 0}, 0.001, 10), true});
    description.bodies.push_back(body_on(GetParam()));
    const auto world = make_kinematic_world(description, 1);
    drive(*world, {speed, 0}, 600);
    EXPECT_NEAR(world->body(robot).pose.x, 1.75 - 1e-6, 1e-8) << speed;
    EXPECT_TRUE(world->body(robot).stalled);
    EXPECT_EQ(world->body(robot).collisions, 1u);
    EXPECT_EQ(world->body(robot).velocity, Velocity());
  }
}

constexpr const char* kind_names[] = {"differential", "synchro", "omni", "ackermann", "skid_steer", "aerial"};

INSTANTIATE_TEST_SUITE_P(Kinds, EveryBase,
                         testing::Values(Kind::differential, Kind::synchro, Kind::omni, Kind::ackermann,
                                         Kind::skid_steer, Kind::aerial),
                         [](const auto& info) { return kind_names[static_cast<std::size_t>(info.param)]; });

}  // namespace
}  // namespace waitpoint::world
