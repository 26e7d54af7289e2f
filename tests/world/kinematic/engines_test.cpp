// SPDX-License-Identifier: BSD-3-Clause
// Both engines give the same world, to the last bit.
#include <gtest/gtest.h>

#include "core/digest.hpp"
#include "tests/world/scenes.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::world {
namespace {

constexpr double half_square_m = 9;

WorldDescription robots_among_shapes() {
  WorldDescription description;
  for (const Shape& shape : random_shapes(1, 40, half_square_m)) {
    description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, true});
  }
  Draws draw(2);
  while (description.bodies.size() < 12) {
    const std::size_t n = description.bodies.size();
    const Pose start = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m), draw(-3, 3)};
    const Shape hull = prism({0.1, 0, 0}, {{0.4, 0}, {0, 0.3}, {-0.3, 0.25}, {-0.3, -0.25}, {0, -0.2}});
    const Shape shape = n % 2 == 0 ? cylinder({0, 0}, 0.3) : n % 4 == 1 ? box({0.1, 0, 0}, 0.8, 0.5) : hull;
    BodyDescription body = nimble_body(numbered("r", n), shape, start);
    if (n % 3 == 1) {
      body.base.kind = BaseDescription::Kind::aerial;
      body.base.climb_max_m_s = body.base.climb_acceleration_m_s2 = 1e5;
      body.start_height_m = draw(0, 2);
    }
    LaserDescription laser;
    laser.height_m = n % 3 == 0 ? 0.4 : 0.6;
    laser.field_of_view_rad = n % 4 == 0 ? 2 * exact::pi : exact::pi;
    laser.mount = {0.15, 0.05, 0.2};
    if (n % 3 == 1) {  // beams with times of their own, width and direction noise
      laser.mirror_turn = std::chrono::milliseconds(15);
      laser.angle_noise_rad = 0.001;
      laser.spot_m = 0.01;
      laser.incidence_max_rad = 1.4;
    }
    body.sensors<Lasers>().push_back(laser);
    if (n % 2 == 0) body.sensors<Sonars>().emplace_back();
    description.bodies.push_back(body);
    if (!start_overlaps(description).empty()) description.bodies.pop_back();
  }
  return description;
}

// All sensor readings of a world that is driven and changed for a while.
Digest readings(VehicleWorld& world, std::uint64_t seed, int steps) {
  Draws draw(seed);
  Digest digest;
  LaserScan scan;
  std::vector<double> sonar;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < 12; ++i)
      world.command(BodyId(i), {draw(-20, 20), draw(-30, 30), draw(-20, 20), draw(-20, 20)});
    world.step();
    if (step % 10 == 3) {
      const Pose to = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m), draw(-3, 3)};
      world.move_body(BodyId(draw.below(12)), to);
      world.put_obstacle({"new", random_shape(draw, half_square_m, 1), false});
    }
    if (step % 10 == 7) world.remove_obstacle("o" + std::to_string(draw.below(40)));
    for (std::size_t i = 0; i < 12; ++i) {
      world.scan(BodyId(i), 0, static_cast<std::uint64_t>(step), scan);
      for (const double range : scan.range_m) digest.add(range);
      if (i % 2 == 0) fire(world, BodyId(i), 0, static_cast<std::uint64_t>(step), sonar);
      for (const double range : sonar) digest.add(range);
      add_value(digest, world.body(BodyId(i)));
    }
    const Beam beam = {{draw(-9, 9), draw(-9, 9)}, draw(-3, 3), 0};
    for (const double height_m : {0.4, 0.5, 0.6}) {  // no sensor is at 0.5 m
      digest.add(world.cast({beam.origin, beam.heading_rad, height_m}, 30));
      digest.add(world.cast({beam.origin, beam.heading_rad, height_m}, 30, BodyId(3)));
    }
  }
  return digest;
}

TEST(Engines, AgreeToTheLastBitWhateverHappens) {
  WorldDescription description = robots_among_shapes();
  const auto by_fcl = make_kinematic_world(description, 7);
  description.engine = Engine::slice;
  const auto by_slice = make_kinematic_world(description, 7);
  const Digest first = readings(*by_fcl, 3, 60);
  EXPECT_EQ(readings(*by_slice, 3, 60), first);
  EXPECT_NE(readings(*by_fcl, 4, 1), first);
  by_slice->reset(7);
  EXPECT_EQ(readings(*by_slice, 3, 60), first) << "back at the start, obstacles too";
}

TEST(Engines, AgreeWhereThereIsNothing) {
  WorldDescription description;
  description.engine = Engine::slice;
  description.bodies.push_back(nimble_body("alone", cylinder({0, 0}, 0.3), {0, 0, 0}));
  description.bodies[0].sensors<Lasers>().push_back(perfect_laser(0.4));
  description.bodies[0].sensors<Sonars>().emplace_back();
  const auto world = make_kinematic_world(description, 1);
  LaserScan scan;
  world->scan(BodyId(0), 0, 1, scan);
  EXPECT_EQ(scan.range_m, std::vector<double>(361, 32.0));
}

}  // namespace
}  // namespace waitpoint::world
