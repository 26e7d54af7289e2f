// SPDX-License-Identifier: BSD-3-Clause
// Scans announced in advance are made together, with the readings that they would have alone.
#include <gtest/gtest.h>

#include "tests/world/scenes.hpp"
#include "world/kinematic/expected_scans.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::world {
namespace {

constexpr std::size_t robots = 12;

WorldDescription crowd(Engine engine) {
  WorldDescription description;
  description.engine = engine;
  for (const Shape& shape : random_shapes(1, 30, 6))
    description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, false});
  Draws draw(2);
  while (description.bodies.size() < robots) {
    const std::size_t n = description.bodies.size();
    BodyDescription body =
        nimble_body(numbered("r", n), cylinder({0, 0}, 0.3), {draw(-6, 6), draw(-6, 6), draw(-3, 3)});
    for (std::size_t i = 0; i <= n % 2; ++i) {
      LaserDescription laser;
      laser.beams = i == 0 ? 12 : 90;
      laser.height_m = i == 0 ? 0.4 : 0.6;
      laser.warm_up_bias_m = 0.1;
      if (n % 3 == 1) laser.mirror_turn = std::chrono::milliseconds(15);
      body.sensors<Lasers>().push_back(laser);
    }
    description.bodies.push_back(body);
    if (!start_overlaps(description).empty()) description.bodies.pop_back();
  }
  return description;
}

std::vector<double> ranges(const VehicleWorld& world, std::size_t body, std::size_t laser, std::uint64_t number) {
  LaserScan scan;
  world.scan(BodyId(body), laser, number, scan);
  EXPECT_EQ(scan.range_max_m, 32);
  scan.range_m.push_back(scan.first_angle_rad);
  scan.range_m.push_back(scan.angle_step_rad);
  return scan.range_m;
}

void drive(World& world, Draws draw) {
  for (std::size_t i = 0; i < robots; ++i)
    world.command(BodyId(i), {draw(-9, 9), draw(-9, 9), draw(-9, 9), draw(-9, 9)});
}

TEST(ExpectedScans, EqualUnexpectedScans) {
  for (const Engine engine : {Engine::fcl, Engine::slice}) {
    const auto told = make_kinematic_world(crowd(engine), 7), untold = make_kinematic_world(crowd(engine), 7);
    for (std::uint64_t step = 1; step <= 20; ++step) {
      for (std::size_t i = 0; i < robots; ++i)
        for (std::size_t laser = 0; laser <= i % 2; ++laser)
          if ((i + laser + step) % 3 != 0) told->expect_scan(BodyId(i), laser, step);
      for (World* const world : {told.get(), untold.get()}) {
        drive(*world, Draws(step));
        world->step();
        if (step % 5 == 0) {  // interventions after the step are visible to scans
          world->move_body(BodyId(step % robots), {9, 9, 1});
          world->remove_obstacle(numbered("o", step));
        }
      }
      for (std::size_t i = 0; i < robots; ++i)
        for (std::size_t laser = 0; laser <= i % 2; ++laser)
          ASSERT_EQ(ranges(*told, i, laser, step), ranges(*untold, i, laser, step)) << i << " at " << step;
      // A scan that was not announced, and one of a past step.
      ASSERT_EQ(ranges(*told, 1, 0, step + 100), ranges(*untold, 1, 0, step + 100));
    }
    told->expect_scan(BodyId(0), 0, 1);
    told->reset(8);
    untold->reset(8);
    EXPECT_EQ(ranges(*told, 0, 0, 1), ranges(*untold, 0, 0, 1));
  }
}

TEST(ExpectedScans, AreAvailableUntilTheNextStep) {
  ExpectedScans scans;
  scans.restart(3);
  EXPECT_FALSE(scans.begin()) << "nothing to make";
  scans.expect(2, 0, 5);
  scans.expect(2, 1, 9);
  scans.expect(0, 0, 5);
  LaserScan found;
  EXPECT_FALSE(scans.find(2, 1, 9, found)) << "not made yet";
  ASSERT_TRUE(scans.begin());
  int made = 0;
  for (std::uint32_t body = 0; body < 3; ++body)
    scans.make(body, [&](const ExpectedScans::Entry& entry, LaserScan& scan) {
      ++made;
      scan = {0.5, 0.25, 30, std::vector<double>(entry.laser + 2, entry.body)};
    });
  EXPECT_EQ(made, 3);
  ASSERT_TRUE(scans.find(2, 1, 9, found));
  EXPECT_EQ(found.range_m, std::vector<double>(3, 2));
  EXPECT_EQ(found.range_max_m, 30);
  EXPECT_FALSE(scans.find(2, 1, 8, found));
  EXPECT_FALSE(scans.find(1, 0, 5, found));
  scans.forget();
  EXPECT_FALSE(scans.find(2, 1, 9, found));
  EXPECT_FALSE(scans.begin());
  EXPECT_FALSE(scans.find(2, 1, 9, found));
}

}  // namespace
}  // namespace waitpoint::world
