// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/base.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

BaseDescription differential() {
  BaseDescription base;
  base.kind = BaseDescription::Kind::differential;
  base.v_max_m_s = 1;
  base.w_max_rad_s = 4;
  return base;
}

double faster_wheel(const BaseDescription& base, Velocity v) {
  return std::fabs(v.v_m_s) + std::fabs(v.w_rad_s) * base.axle_m / 2;
}

TEST(Base, ASynchroBaseClampsEachAxis) {
  BaseDescription base;
  base.v_max_m_s = 1;
  base.w_max_rad_s = 2;
  EXPECT_EQ(limited(base, {3, -5}), (Velocity{1, -2}));
  EXPECT_EQ(limited(base, {-0.3, 0.7}), (Velocity{-0.3, 0.7}));
}

TEST(Base, ADifferentialBaseSlowsBothWheelsAlike) {
  const BaseDescription base = differential();
  const Velocity velocity = limited(base, {0.9, 3});
  EXPECT_NEAR(faster_wheel(base, velocity), 1, 1e-15);
  EXPECT_NEAR(velocity.w_rad_s / velocity.v_m_s, 3 / 0.9, 1e-12) << "the curvature is kept";
}

TEST(Base, NeitherLimitIsEverExceeded) {
  const BaseDescription base = differential();
  Draws draw(1);
  Velocity now;
  for (int i = 0; i < 100000; ++i) {
    const Velocity wanted = {draw(-2, 2), draw(-8, 8)};
    for (int k = 0; k < 20; ++k) {
      const Velocity next = next_motion(base, {now}, wanted, 0.01).velocity;
      ASSERT_LE(std::fabs(next.v_m_s - now.v_m_s), 0.01 + 1e-15);
      ASSERT_LE(std::fabs(next.w_rad_s - now.w_rad_s), 0.03 + 1e-15);
      ASSERT_LE(faster_wheel(base, next), 1 + 1e-12);
      now = next;
    }
  }
}

TEST(Base, ItGetsWhereItWasTold) {
  const BaseDescription base = differential();
  Velocity now = {1, 0};
  for (int i = 0; i < 400; ++i) now = next_motion(base, {now}, {-0.2, 3}, 0.01).velocity;
  EXPECT_EQ(now, (Velocity{-0.2, 3}));
}

TEST(Battery, FallsWithTimeAndDistanceAndStaysAtEmpty) {
  BaseDescription base;
  base.battery_capacity_s = 1000;
  base.battery_capacity_m = 500;
  EXPECT_EQ(base_battery(base, 0, 0).volts, 26);
  EXPECT_NEAR(base_battery(base, 500, 0).volts, 24, 1e-12);
  EXPECT_NEAR(base_battery(base, 250, 125).volts, 24, 1e-12);
  EXPECT_EQ(base_battery(base, 5000, 0).volts, 22);
}

}  // namespace
}  // namespace waitpoint::world
