// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/sonar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"
#include "world/sensors/sonar_crosstalk.hpp"

namespace waitpoint::world {
namespace {

// One forward sonar at the body's centre line, without noise.
SonarRingDescription forward_sonar() {
  SonarRingDescription ring;
  ring.count = 1;
  ring.range_noise_relative = 0;
  return ring;
}

double range(const std::vector<Shape>& shapes, double heading, const SonarRingDescription& ring = forward_sonar()) {
  WorldDescription description;
  for (const Shape& shape : shapes) {
    description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, true});
  }
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, heading}));
  description.bodies[0].sensors<Sonars>().push_back(ring);
  std::vector<double> ranges;
  fire(*make_kinematic_world(description, 1), BodyId(0), 0, 1, ranges);
  return ranges.at(0);
}

TEST(Sonar, AWallAnswersOnlyIfItsPerpendicularLiesInTheCone) {
  const std::vector<Shape> wall = {box({2.5, 0, 0}, 1, 20)};  // its face at x = 2
  for (const double heading : {0.0, 0.1, -0.2, 0.217}) {
    EXPECT_NEAR(range(wall, heading), 2 - 0.25 * std::cos(heading), 1e-9) << "the perpendicular, not the axis";
  }
  EXPECT_EQ(range(wall, 0.22), 3);
  EXPECT_EQ(range(wall, -0.6), 3) << "a mirror that looks elsewhere";
  EXPECT_EQ(range(wall, exact::pi), 3);
}

TEST(Sonar, ACylinderAnswersFromAnywhereInTheCone) {
  const std::vector<Shape> pole = {cylinder({2, 0.2}, 0.1)};
  EXPECT_NEAR(range(pole, 0), std::hypot(1.75, 0.2) - 0.1, 1e-9);
  EXPECT_EQ(range(pole, -0.3), 3);
}

TEST(Sonar, AConcaveCornerThrowsSoundBackOverTheWholeCone) {
  // Two walls that meet at (1.5, 1.5): neither faces a sonar that points at their corner.
  const std::vector<Shape> corner = {box({1.6, 0, 0}, 0.2, 3.4), box({0, 1.6, 0}, 3.4, 0.2)};
  const double distance = std::hypot(1.5, 1.5) - 0.25;
  EXPECT_NEAR(range(corner, exact::pi / 4), distance, 1e-9);
  const double turned = exact::pi / 4 + 0.15;
  EXPECT_NEAR(range(corner, turned), std::hypot(1.5 - 0.25 * std::cos(turned), 1.5 - 0.25 * std::sin(turned)), 1e-9);
  EXPECT_EQ(range(corner, exact::pi / 4 + 0.3), 3);
}

TEST(Sonar, APrismAnswersByItsSidesAndEdges) {
  // Its nose is 1 m ahead; of its two sides there one faces a sonar turned by 0.6 rad, 0.8 m away.
  const auto [s, c] = exact::sincos(0.6);
  const Point nose = {1, 0}, left = nose + 2 * Point{-s, c}, right = {3, -1};
  const std::vector<Shape> hull = {prism({0, 0, 0}, {nose, left, right, {4, 0}})};
  EXPECT_NEAR(range(hull, 0), 0.75, 1e-9) << "the edge";
  EXPECT_EQ(range(hull, -0.3), 3) << "no side of it faces that way";
  EXPECT_NEAR(range(hull, 0.6), c - 0.25, 1e-9);
}

TEST(Sonar, AnEdgeAnswersWeakly) {
  const auto edge_at = [](double x) { return std::vector<Shape>{box({x + std::sqrt(0.5), 0, exact::pi / 4}, 1, 1)}; };
  EXPECT_NEAR(range(edge_at(1.5), 0), 1.25, 1e-9);
  EXPECT_EQ(range(edge_at(2), 0), 3) << "too far for an edge";
  EXPECT_EQ(range(edge_at(1.5), 0.15), 3) << "in the cone, but not in its middle";
}

TEST(Sonar, NearerObstacleHidesAnEcho) {
  // The tilted plate deflects the sound; the wall behind it gives no echo.
  const Shape wall = box({2.5, 0, 0}, 1, 20), plate = box({1.2, 0, 0.7}, 0.05, 3);
  EXPECT_EQ(range({wall, plate}, 0), 3);
  Shape low_plate = plate;
  low_plate.z_high_m = 0.3;
  EXPECT_NEAR(range({wall, low_plate}, 0), 1.75, 1e-9) << "the sonar looks over it";
}

TEST(Sonar, NothingIsNearerThanItsLeastRange) { EXPECT_EQ(range({box({0.85, 0, 0}, 1, 20)}, 0), 0.15); }

TEST(Sonar, ARingLooksAroundCounterClockwise) {
  WorldDescription description;
  description.obstacles.push_back({"wall", box({0, 2.5, 0}, 20, 1), true});
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  SonarRingDescription ring;
  ring.range_noise_relative = 0;
  description.bodies[0].sensors<Sonars>().push_back(ring);
  std::vector<double> ranges;
  fire(*make_kinematic_world(description, 1), BodyId(0), 0, 1, ranges);
  ASSERT_EQ(ranges.size(), 24u);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(ranges[i] == 3, i != 6) << i;
  EXPECT_NEAR(ranges[6], 1.75, 1e-9);
}

SonarRingDescription quiet_ring() {
  SonarRingDescription ring;
  ring.range_noise_relative = 0;
  ring.half_cone_rad = 12.5 * exact::pi / 180;
  return ring;
}

// A robot between a pole, 6 degrees to the left of its nose, and walls.
std::unique_ptr<World> among_things(const std::vector<SonarRingDescription>& rings) {
  WorldDescription description;
  const auto [s, c] = exact::sincos(6 * exact::pi / 180);
  for (const Shape& shape : {cylinder({c, s}, 0.05), box({0, 2.5, 0}, 20, 1), box({-2, 0, 0.1}, 1, 9)})
    description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, true});
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].sensors<Sonars>() = rings;
  return make_kinematic_world(description, 1);
}

TEST(Sonar, BanksFireOneMemberEachInTheOrderGiven) {
  SonarRingDescription ring = quiet_ring();
  std::vector<double> all, in_turns;
  fire(*among_things({ring}), BodyId(0), 0, 0, all);
  ring.firing_order = {2, 0, 3, 1};
  const auto world = among_things({ring});
  in_turns.assign(24, -1);
  for (std::uint64_t firing = 0; firing < 8; ++firing) {
    fire(*world, BodyId(0), 0, firing, in_turns);
    for (std::size_t i = 0; i < 24; ++i) {
      const std::size_t turn = i % 4 == 2 ? 0 : i % 4 == 0 ? 1 : i % 4 == 3 ? 2 : 3;
      EXPECT_EQ(in_turns[i], turn <= firing ? all[i] : -1) << i << " after " << firing;
    }
  }
  in_turns.clear();
  fire(*world, BodyId(0), 0, 0, in_turns);
  EXPECT_EQ(in_turns[0], 3) << "what has not fired yet has no echo";
}

// By its own sound, sonar 1 hears the pole at 0.7041 m; sonar 0 is nearer to it, so half of the path from there is
// less.
TEST(Sonar, NeighboursThatFireTogetherHearEachOther) {
  SonarRingDescription ring = quiet_ring();
  std::vector<double> alone, together, in_turns;
  fire(*among_things({ring}), BodyId(0), 0, 0, alone);
  ring.crosstalk = true;
  fire(*among_things({ring}), BodyId(0), 0, 0, together);
  EXPECT_NEAR(alone[1] - alone[0], 0.0023, 1e-4);
  EXPECT_NEAR(together[1], 0.5 * (alone[0] + alone[1]), 1e-4);
  EXPECT_EQ(together[0], alone[0]) << "its own echo comes first";
  ring.firing_order = {0, 1, 2, 3};
  const auto world = among_things({ring});
  for (std::uint64_t firing = 0; firing < 4; ++firing) fire(*world, BodyId(0), 0, firing, in_turns);
  EXPECT_EQ(in_turns, alone) << "sixty degrees apart, none hears another";
}

// A B21r's 48: the lower ring is a centimetre wider, so its echo arrives a little earlier.
TEST(Sonar, RingsOfOneBodyHearEachOther) {
  SonarRingDescription upper = quiet_ring(), lower = quiet_ring();
  lower.ring_radius_m = 0.26;
  upper.crosstalk = lower.crosstalk = true;
  std::vector<double> with, without;
  fire(*among_things({upper, lower}), BodyId(0), 0, 0, with);
  lower.crosstalk = false;
  fire(*among_things({upper, lower}), BodyId(0), 0, 0, without);
  EXPECT_NEAR(without[6], 1.75, 1e-9);
  EXPECT_NEAR(with[6], 1.745, 1e-9) << "half of 1.75 m and 1.74 m";
}

TEST(Sonar, ObstacleOnEitherPathHidesTheCrossEcho) {
  const SonarRingDescription ring = quiet_ring();
  const SonarCone a(ring, {0, 0, 0}), b(ring, {0, 0.2, 0});
  std::vector<CrossEcho> echoes;
  add_cross_echoes(a, b, outline_of(box({2.5, 0, 0}, 1, 20)), echoes);
  ASSERT_EQ(echoes.size(), 1u);
  EXPECT_NEAR(echoes[0].at.x, 2, 1e-12);
  EXPECT_NEAR(echoes[0].at.y, 0.1, 1e-12);
  EXPECT_NEAR(echoes[0].distance_m, 0.5 * std::hypot(4, 0.2), 1e-12) << "as from the mirror image";
  echoes.clear();
  add_cross_echoes(a, b, outline_of(box({2.5, 5.15, 0}, 1, 10)), echoes);
  EXPECT_TRUE(echoes.empty()) << "the wall begins beside the reflection";
  add_cross_echoes(a, SonarCone(ring, {0, 0.2, 0.3}), outline_of(box({2.5, 0, 0}, 1, 20)), echoes);
  EXPECT_TRUE(echoes.empty()) << "it arrives outside of the cone";
  EXPECT_TRUE(may_hear(a, b));
  EXPECT_FALSE(may_hear(a, SonarCone(ring, {0, 0.2, 0.5}))) << "beyond both half cones";
}

TEST(Sonar, RangesAreThoseOfTheTemperatureThatItIsCalibratedFor) {
  SonarRingDescription ring = quiet_ring();
  EXPECT_EQ(sonar_range_m(ring, 2, 0), 2);
  ring.air_celsius = 0;
  EXPECT_NEAR(sonar_range_m(ring, 2, 0), 2 * 343.42 / 331.3, 1e-12) << "colder air carries sound slower";
}

TEST(Sonar, NoiseIsAShareOfTheRange) {
  SonarRingDescription ring;
  RandomStream draws = sonar_noise(1, "robot", 0);
  double squares = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double error = sonar_range_m(ring, 2, draws.normal(i)) - 2;
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / 20000), 0.02, 0.0006);
  EXPECT_EQ(sonar_range_m(ring, HUGE_VAL, 0), 3);
}

}  // namespace
}  // namespace waitpoint::world
