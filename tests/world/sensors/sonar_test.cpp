// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/sonar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"

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
  description.bodies[0].sonars.push_back(ring);
  std::vector<double> ranges;
  make_fcl_world(description, 1)->sonar(BodyId(0), 0, 1, ranges);
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
  // Two walls that meet at (1.5, 1.5): neither faces a sonar that looks at their corner.
  const std::vector<Shape> corner = {box({1.6, 0, 0}, 0.2, 3.4), box({0, 1.6, 0}, 3.4, 0.2)};
  const double distance = std::hypot(1.5, 1.5) - 0.25;
  EXPECT_NEAR(range(corner, exact::pi / 4), distance, 1e-9);
  const double turned = exact::pi / 4 + 0.15;
  EXPECT_NEAR(range(corner, turned), std::hypot(1.5 - 0.25 * std::cos(turned), 1.5 - 0.25 * std::sin(turned)), 1e-9);
  EXPECT_EQ(range(corner, exact::pi / 4 + 0.3), 3);
}

TEST(Sonar, AnEdgeAnswersWeakly) {
  const auto edge_at = [](double x) { return std::vector<Shape>{box({x + std::sqrt(0.5), 0, exact::pi / 4}, 1, 1)}; };
  EXPECT_NEAR(range(edge_at(1.5), 0), 1.25, 1e-9);
  EXPECT_EQ(range(edge_at(2), 0), 3) << "too far for an edge";
  EXPECT_EQ(range(edge_at(1.5), 0.15), 3) << "in the cone, but not in its middle";
}

TEST(Sonar, WhatStandsBeforeItHidesIt) {
  // The tilted plate throws the sound away; behind it the wall cannot be heard.
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
  description.bodies[0].sonars.push_back(ring);
  std::vector<double> ranges;
  make_fcl_world(description, 1)->sonar(BodyId(0), 0, 1, ranges);
  ASSERT_EQ(ranges.size(), 24u);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(ranges[i] == 3, i != 6) << i;
  EXPECT_NEAR(ranges[6], 1.75, 1e-9);
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
