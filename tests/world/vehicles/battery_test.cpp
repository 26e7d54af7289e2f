// SPDX-License-Identifier: BSD-3-Clause
// The battery model: Peukert's law, the voltage under load, and a robot with an empty battery.
#include "world/vehicles/battery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

const Duration second = std::chrono::seconds(1);

/// The time at which it is empty, drained at one velocity; at most a week.
double emptied_after_s(const Battery::Description& description, const Velocity& velocity = {}) {
  BatteryPack battery(description);
  for (int s = 1; s <= 7 * 86400; ++s) {
    battery.draw(s * second, second, velocity, false);
    if (battery.empty()) return battery.reading().empty_after.seconds();
  }
  return INFINITY;
}

TEST(Battery, AtAConstantCurrentIsEmptyWhenPeukertsLawSays) {
  for (const double peukert : {1.0, 1.15, 1.3}) {
    for (const double current_a : {1.0, 2.0, 10.0, 40.0}) {
      const Battery::Description battery = {.capacity_ah = 40, .rated_h = 20, .peukert = peukert, .idle_a = current_a};
      const double hours = 20 * std::pow(40 / (current_a * 20), peukert);
      EXPECT_NEAR(emptied_after_s(battery), hours * 3600, 1.001) << current_a << " A, " << peukert;
    }
  }
}

TEST(Battery, MotionDrawsByItsKeys) {
  const Battery::Description battery = {.capacity_ah = 1,
                                        .rated_h = 1,
                                        .peukert = 1,
                                        .idle_a = 1,
                                        .drive_a_per_m_s = 4,
                                        .turn_a_per_rad_s = 2,
                                        .climb_a_per_m_s = 10};
  EXPECT_NEAR(emptied_after_s(battery, {-0.5, 0.25}), 3600 / 3.5, 1);
  EXPECT_NEAR(emptied_after_s(battery, {.v_m_s = 0.3, .side_m_s = 0.4}), 3600 / 3.0, 1);
  EXPECT_NEAR(emptied_after_s(battery, {.climb_m_s = 0.2}), 3600 / 3.0, 1);
  EXPECT_NEAR(emptied_after_s(battery, {.climb_m_s = -0.2}), 3600, 1);
  BatteryPack pushing({.idle_a = 2, .stalled_a = 20});
  pushing.draw(second, second, {}, true);
  EXPECT_EQ(pushing.reading().current_a, 22);
}

TEST(Battery, ItsVoltageFallsWithTheChargeAndSagsUnderLoad) {
  BatteryPack battery({.volts_full = 26,
                       .volts_empty = 22,
                       .resistance_ohm = 0.1,
                       .capacity_ah = 10,
                       .rated_h = 1,
                       .peukert = 1,
                       .charge = 0.75,
                       .idle_a = 5,
                       .drive_a_per_m_s = 10});
  EXPECT_NEAR(battery.reading().volts, 25 - 0.5, 1e-12);
  for (int s = 1; s <= 1800; ++s) battery.draw(s * second, second, {}, false);
  EXPECT_NEAR(battery.reading().charge, 0.5, 1e-9);
  EXPECT_NEAR(battery.reading().volts, 24 - 0.5, 1e-9);
  battery.draw(1801 * second, second, {0.5, 0}, false);
  EXPECT_NEAR(battery.reading().volts, 24 - 1.0, 0.002);
  BatteryPack coarse({.resolution_v = 0.5});
  EXPECT_EQ(coarse.reading().volts, 26);
}

TEST(Battery, UnderLoadGoesOffBeforeItIsDrained) {
  // 26 V - 4 V q - 0.1 Ohm * 10 A = 23 V where q = 1 / 2.
  const Battery::Description description = {.volts_full = 26,
                                            .volts_empty = 22,
                                            .resistance_ohm = 0.1,
                                            .capacity_ah = 10,
                                            .rated_h = 1,
                                            .peukert = 1,
                                            .off_v = 23,
                                            .idle_a = 10};
  EXPECT_NEAR(emptied_after_s(description), 1800, 1.001);
  BatteryPack battery(description);
  for (int s = 1; s <= 2000; ++s) battery.draw(s * second, second, {}, false);
  EXPECT_TRUE(battery.empty()) << "although without load the voltage is above again";
  EXPECT_NEAR(battery.reading().volts, 24, 0.01);
  EXPECT_EQ(battery.reading().current_a, 0);
}

/// Drives at 0.5 m/s on a charge for 2 s.
WorldDescription short_drive(BaseDescription::Kind kind) {
  WorldDescription description;
  BodyDescription body = nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0});
  body.base.kind = kind;
  body.base.v_acceleration_m_s2 = 1;
  body.sensors<Battery>() =
      Battery::Description{.resistance_ohm = 0, .capacity_ah = 1, .rated_h = 1, .peukert = 1, .idle_a = 1800};
  if (kind == BaseDescription::Kind::aerial) body.start_height_m = 1;
  description.bodies.push_back(body);
  return description;
}

TEST(Battery, WithoutItABaseBrakesToStandStillAndHearsNoCommand) {
  const auto world = make_kinematic_world(short_drive(BaseDescription::Kind::synchro), 1);
  for (int i = 0; i < 200; ++i) {
    world->command(BodyId(0), {0.5, 0});
    world->step();
  }
  ASSERT_TRUE(reading<Battery>(*world).empty);
  ASSERT_EQ(reading<Battery>(*world).empty_after, Duration(2 * second));
  EXPECT_EQ(world->body(BodyId(0)).velocity.v_m_s, 0.5);
  const double x = world->body(BodyId(0)).pose.x;
  for (int i = 0; i < 100; ++i) {
    world->command(BodyId(0), {0.5, 0});
    world->step();
  }
  EXPECT_EQ(world->body(BodyId(0)).velocity, Velocity());
  EXPECT_NEAR(world->body(BodyId(0)).pose.x - x, 0.5 * 0.5 / 2, 0.01) << "v^2 / 2a";
  world->reset(1);
  EXPECT_FALSE(reading<Battery>(*world).empty);
}

TEST(Battery, WithoutItWhatFliesSinksToTheFloor) {
  const auto world = make_kinematic_world(short_drive(BaseDescription::Kind::aerial), 1);
  for (int i = 0; i < 200; ++i) world->step();
  EXPECT_EQ(world->body(BodyId(0)).height_m, 1);
  for (int i = 0; i < 300; ++i) world->step();
  EXPECT_EQ(world->body(BodyId(0)).height_m, 0);
}

}  // namespace
}  // namespace waitpoint::world
