// SPDX-License-Identifier: BSD-3-Clause
// Loose shapes fall, slide, rest and tip over according to mechanics.
#include <cmath>

#include "tests/world/bullet/worlds.hpp"

namespace waitpoint::world {
namespace {

using LooseThings = DynamicWorldTest;

TEST_F(LooseThings, AreAcceleratedByAForceAsTheirMassSays) {
  description_.obstacles = {loose_box("sledge", {0, 0, 0.5}, 8, 0)};
  start();
  EXPECT_EQ(world_->push("sledge", {16, 0}, std::chrono::seconds(1)), std::nullopt);
  run(1);
  const LooseState& sledge = world_->loose()[0];
  EXPECT_NEAR(sledge.velocity_m_s.x, 2, 1e-6);
  EXPECT_NEAR(sledge.pose.x, 1, 0.005);
  run(1);
  EXPECT_NEAR(sledge.velocity_m_s.x, 2, 1e-6) << "nothing slows it on ice";
  EXPECT_NEAR(sledge.pose.x, 3, 0.005);
  EXPECT_NEAR(sledge.pose.heading, 0.5, 1e-4);
}

// v^2 / (2 mu g), to 5 %.
TEST_F(LooseThings, SlideAsFarAsTheirFrictionLetsThem) {
  for (const double heading : {0.0, 0.4}) {
    for (const double mu : {0.2, 0.5}) {
      description_.obstacles = {loose_box("box", {0, 0, heading}, 10, mu)};
      start();
      const double force_n = 200, acceleration = force_n / 10 - mu * g_m_s2, time_s = 0.1;
      world_->push("box", {force_n, 0}, Duration::from_seconds(time_s));
      run(time_s);
      const double x = world_->loose()[0].pose.x, v = world_->loose()[0].velocity_m_s.x;
      EXPECT_NEAR(v, acceleration * time_s, 0.02 * acceleration * time_s);
      run(3);
      const double way_m = v * v / (2 * mu * g_m_s2);
      EXPECT_NEAR(world_->loose()[0].pose.x - x, way_m, 0.05 * way_m) << heading << " " << mu;
      EXPECT_NEAR(world_->loose()[0].pose.y, 0, 0.02);
      EXPECT_EQ(world_->loose()[0].velocity_m_s, Point()) << "it came to rest";
    }
  }
}

TEST_F(LooseThings, StayWhereFrictionHoldsThem) {
  description_.obstacles = {loose_box("box", {1, 2, 0.3}, 10, 0.5)};
  start();
  world_->push("box", {0.95 * 0.5 * 10 * g_m_s2, 0}, std::chrono::seconds(2));
  run(2);
  EXPECT_NEAR(world_->loose()[0].pose.x, 1, 1e-3);
  EXPECT_NEAR(world_->loose()[0].pose.y, 2, 1e-3);
}

TEST_F(LooseThings, FallFreelyAndSettleOnTheFloorAndOnEachOther) {
  Obstacle low = loose_box("low", {0, 0, 0}, 5), high = loose_box("high", {0, 0, 0.2}, 2);
  low.shape = raised(low.shape, 1);
  high.shape = raised(high.shape, 1.8);
  description_.obstacles = {low, high};
  start();
  run(0.3);
  EXPECT_NEAR(obstacle(0).z_low_m, 1 - 0.5 * g_m_s2 * 0.3 * 0.3, 0.005);
  EXPECT_NEAR(world_->loose()[0].climb_m_s, -g_m_s2 * 0.3, 1e-6);
  run(4);
  EXPECT_NEAR(obstacle(0).z_low_m, 0, 1e-3);
  EXPECT_NEAR(obstacle(1).z_low_m, 0.5, 2e-3);
  EXPECT_NEAR(obstacle(1).pose.x, 0, 0.02);
  const Shape before = obstacle(1);
  run(1);
  EXPECT_EQ(obstacle(1).pose, before.pose) << "what has come to rest stays to the last bit";
  EXPECT_EQ(obstacle(1).z_low_m, before.z_low_m);
}

// A force at its middle beyond m g width / height tips it before it slides.
TEST_F(LooseThings, TipOverWherePushedHighAndAreShapesThatLie) {
  Obstacle column{"column", box({0, 0, 0}, 0.3, 0.3), true, 5, 0.8};
  column.shape.z_high_m = 1.5;
  description_.obstacles = {column};
  start();
  world_->push("column", {0.9 * 5 * g_m_s2 * 0.3 / 1.5, 0}, std::chrono::seconds(1));
  run(3);
  EXPECT_NEAR(obstacle(0).z_high_m, 1.5, 1e-3) << "too weak";
  world_->push("column", {2 * 5 * g_m_s2 * 0.3 / 1.5, 0}, std::chrono::milliseconds(600));
  run(5);
  EXPECT_NEAR(obstacle(0).z_low_m, 0, 1e-3);
  EXPECT_NEAR(obstacle(0).z_high_m, 0.3, 1e-3);
  EXPECT_NEAR(std::max(obstacle(0).length_m, obstacle(0).width_m), 1.5, 1e-3);
}

TEST_F(LooseThings, AreStoppedByWhatStands) {
  description_.obstacles = {loose_box("box", {0, 0, 0}, 5, 0), wall({2, 0, 0}, 0.2, 3)};
  start();
  world_->push("box", {50, 0}, std::chrono::milliseconds(100));
  run(4);
  EXPECT_NEAR(world_->loose()[0].pose.x, 2 - 0.1 - 0.3, 0.005);
  EXPECT_EQ(world_->push("wall", {1, 0}, std::chrono::seconds(1)), "'wall' stands fast");
  EXPECT_EQ(world_->push("door", {1, 0}, std::chrono::seconds(1)), "there is no 'door'");
}

TEST_F(LooseThings, ArePutMovedAndTakenAwayWhileTheOthersGoOn) {
  description_.obstacles = {loose_box("sledge", {0, 0, 0}, 5, 0), loose_box("box", {0, 2, 0}, 5)};
  start();
  world_->push("sledge", {10, 0}, std::chrono::seconds(1));
  run(1);
  EXPECT_EQ(world_->put_obstacle(loose_box("third", {0, 2.3, 0}, 5)), "box") << "in its way";
  EXPECT_EQ(world_->put_obstacle(loose_box("third", {5, 5, 0}, 5)), std::nullopt);
  EXPECT_TRUE(world_->remove_obstacle("box"));
  EXPECT_FALSE(world_->remove_obstacle("box"));
  ASSERT_EQ(world_->loose().size(), 2u);
  run(1);
  EXPECT_NEAR(world_->loose()[0].velocity_m_s.x, 2, 1e-6) << "the sledge went on";
  EXPECT_EQ(world_->description().obstacles[world_->loose()[1].obstacle].name, "third");
  world_->reset(1);
  EXPECT_EQ(world_->description().obstacles[1].name, "box");
  EXPECT_EQ(world_->loose()[0].pose.x, 0);
}

}  // namespace
}  // namespace waitpoint::world
