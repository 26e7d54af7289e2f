// SPDX-License-Identifier: BSD-3-Clause
// Each beam at its own time, by the arithmetic of a mirror with 75 turns a second.
#include "world/sensors/laser_timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"
#include "tests/world/sensors/statistics.hpp"
#include "world/sensors/laser_models.hpp"

namespace waitpoint::world {
namespace {

constexpr double turn_s = 1.0 / 75;

LaserDescription lms(std::uint32_t beams, double degrees) {
  LaserDescription laser = lms_200();
  laser.beams = beams;
  laser.field_of_view_rad = radians_of_degrees(degrees);
  EXPECT_EQ(set_lms_mode(laser), std::nullopt);
  return laser;
}

TEST(LaserTiming, AScanOfWholeDegreesIsHalfATurn) {
  const LaserDescription laser = lms(181, 180);
  EXPECT_EQ(laser.interlaced_turns, 1u);
  EXPECT_NEAR(scan_span_s(laser), 0.00667, 1e-5);
  EXPECT_NEAR(beam_time_s(laser, 1) - beam_time_s(laser, 0), 37e-6, 1e-7);
  EXPECT_NEAR(least_period(laser).seconds(), turn_s, 1e-8);
}

// At 1 rad/s neighbouring beams are 0.76 degrees of heading apart, and the first and last 1.15.
TEST(LaserTiming, HalfDegreesAreInterlaced) {
  const LaserDescription laser = lms(361, 180);
  EXPECT_EQ(laser.interlaced_turns, 2u);
  EXPECT_NEAR(beam_time_s(laser, 1) - beam_time_s(laser, 0), radians_of_degrees(0.76), 1e-4);
  EXPECT_NEAR(scan_span_s(laser), radians_of_degrees(1.146), 5e-5);
  EXPECT_NEAR(least_period(laser).seconds(), 2 * turn_s, 1e-8);
  EXPECT_NEAR(least_period(lms(401, 100)).seconds(), 4 * turn_s, 1e-8);
}

TEST(LaserTiming, AnLmsDoesNotDoWhatItCannot) {
  for (const auto& [beams, degrees] : {std::pair{721u, 180.0}, {360u, 180.0}, {361u, 120.0}}) {
    LaserDescription laser = lms_291();
    laser.beams = beams;
    laser.field_of_view_rad = radians_of_degrees(degrees);
    EXPECT_TRUE(set_lms_mode(laser).has_value()) << beams << " beams over " << degrees;
  }
}

TEST(LaserTiming, TheLineTakesTenBitsAByte) {
  LaserDescription laser = lms(361, 180);
  EXPECT_EQ(telegram_bytes(laser), 732u);
  EXPECT_EQ(Lasers::transmission(laser), Duration::from_ns(14'640'000));
  laser.line_bit_s = 38400;
  EXPECT_EQ(Lasers::transmission(laser), Duration::from_ns(190'625'000));
  EXPECT_EQ(least_period(laser), Lasers::transmission(laser)) << "five scans a second";
  laser.line_bit_s = 0;
  EXPECT_EQ(Lasers::transmission(laser), Duration());
}

// --- what a moving robot sees ------------------------------------------------------------------------------------

// Free space on all sides; a robot that scans with these beams after `steps` of a constant velocity.
struct Ride {
  std::unique_ptr<VehicleWorld> world;
  LaserScan scan;

  Ride(const LaserDescription& laser, Velocity velocity, int steps) {
    WorldDescription description;
    for (const Shape& shape : {box({8, 0, 0}, 1, 40), box({-9, 0, 0}, 1, 40), box({0, 6, 0.2}, 40, 1),
                               box({0, -7, 0}, 40, 1), cylinder({3, 2}, 0.5)})
      description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, true});
    description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0.3, -0.2, 0.7}));
    description.bodies[0].sensors<Lasers>().push_back(laser);
    world = make_kinematic_world(description, 1);
    world->command(BodyId(0), velocity);
    for (int i = 0; i < steps; ++i) world->step();
    world->scan(BodyId(0), 0, 1, scan);
  }
};

LaserDescription perfect_lms() {
  LaserDescription laser = perfect_laser(0.4);
  laser.mount = {0.1, 0.05, 0.3};
  laser.mirror_turn = lms_200().mirror_turn;
  laser.interlaced_turns = 2;
  return laser;
}

// The pose of a body that has moved at `velocity` since the start, at `time_s`.
Pose moved(Velocity velocity, double time_s) {
  return Arc{{0.3, -0.2, 0.7}, velocity.v_m_s * time_s, velocity.w_rad_s * time_s}.end();
}

TEST(LaserTiming, EachBeamLeavesFromWhereTheDeviceWasThen) {
  const LaserDescription laser = perfect_lms();
  const Velocity velocity = {0.8, 1.2};
  const Ride ride(laser, velocity, 30);
  double greatest_change = 0;
  for (std::uint32_t i = 0; i < laser.beams; ++i) {
    const double age_s = scan_span_s(laser) - beam_time_s(laser, i);
    const double angle = ride.scan.first_angle_rad + i * ride.scan.angle_step_rad;
    const auto range_from = [&](const Pose& body) {
      const Pose device = compose(body, laser.mount);
      return ride.world->cast({device.position(), device.heading + angle, laser.height_m}, 32, BodyId(0));
    };
    EXPECT_NEAR(ride.scan.range_m[i], range_from(moved(velocity, 0.3 - age_s)), 1e-9) << i;
    greatest_change = std::max(greatest_change, std::fabs(ride.scan.range_m[i] - range_from(moved(velocity, 0.3))));
  }
  EXPECT_GT(greatest_change, 0.05) << "which is not what it would see from where it is";
}

TEST(LaserTiming, AtRestItIsTheScanOfOneInstantToTheLastBit) {
  LaserDescription instant = perfect_lms();
  instant.mirror_turn = Duration();
  EXPECT_EQ(Ride(perfect_lms(), {}, 5).scan.range_m, Ride(instant, {}, 5).scan.range_m);
}

TEST(LaserTiming, BeforeTheStartAndBeforeBeingPutDownTheRobotStoodThere) {
  LaserDescription instant = perfect_lms();
  instant.mirror_turn = Duration();
  EXPECT_EQ(Ride(perfect_lms(), {1, 1}, 0).scan.range_m, Ride(instant, {}, 0).scan.range_m);
  Ride ride(perfect_lms(), {1, 1}, 20), at_rest(instant, {}, 0);
  for (Ride* each : {&ride, &at_rest}) {
    EXPECT_EQ(each->world->move_body(BodyId(0), {-1, 1, 2}), std::nullopt);
    each->world->scan(BodyId(0), 0, 1, each->scan);
  }
  EXPECT_EQ(ride.scan.range_m, at_rest.scan.range_m);
}

}  // namespace
}  // namespace waitpoint::world
