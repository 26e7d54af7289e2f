// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/infrareds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"
#include "tests/world/sensors/statistics.hpp"

namespace waitpoint::world {
namespace {

double range_of(const Infrareds::Description& ring, double volts) {
  return std::pow(ring.gain_per_v * volts, ring.exponent);
}

Infrareds::Description exact_ring() {
  Infrareds::Description ring;
  ring.noise_v = 0;
  ring.resolution_v = 1e-9;
  return ring;
}

TEST(Infrared, TheVoltageIsTheInverseOfTheRangesLaw) {
  Infrareds::Description ring = exact_ring();
  for (const double exponent : {-1.0, -1.4}) {
    ring.exponent = exponent;
    for (const double range : {0.1, 0.33, 0.8}) EXPECT_NEAR(range_of(ring, infrared_v(ring, range, 0)), range, 1e-7);
    EXPECT_EQ(infrared_v(ring, 0.02, 0), infrared_v(ring, 0.1, 0)) << "as at its least range";
    EXPECT_EQ(infrared_v(ring, 3, 0), infrared_v(ring, 0.8, 0)) << "no echo";
  }
}

TEST(Infrared, NoiseOfTheVoltageGrowsWithTheRangeSquared) {
  const Infrareds::Description ring;
  const RandomStream noise(1, "robot", "infrared.volts");
  for (const double range : {0.15, 0.3, 0.6}) {
    std::vector<double> volts, ranges;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      volts.push_back(infrared_v(ring, range, noise.normal(i)));
      ranges.push_back(range_of(ring, volts.back()));
    }
    const double deviation_v = std::sqrt(0.01 * 0.01 + 0.005 * 0.005 / 12);
    EXPECT_NEAR(statistics_of(volts).deviation, deviation_v, 0.03 * deviation_v);
    const double expected = ring.gain_per_v * range * range * deviation_v;
    EXPECT_NEAR(statistics_of(ranges).deviation, expected, 0.05 * expected) << range;
  }
}

TEST(Infrared, ARingLooksAroundCounterClockwiseAtItsHeight) {
  WorldDescription description;
  description.obstacles.push_back({"wall", box({0, 1, 0}, 9, 1), true});  // its face at y = 0.5
  Shape sill = box({1, 0, 0}, 1, 9);
  sill.z_high_m = 0.4;
  description.obstacles.push_back({"sill", sill, true});
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].sensors<Infrareds>() = exact_ring();
  std::vector<double> slice_v, volts;
  for (const Engine engine : {Engine::slice, Engine::fcl}) {
    description.engine = engine;
    const Infrareds::Reading measured = reading<Infrareds>(*make_kinematic_world(description, 1), BodyId(0), 1);
    volts.assign(measured.volts.begin(), measured.volts.end());
    ASSERT_EQ(volts.size(), 24u);
    if (engine == Engine::slice) slice_v = volts;
  }
  EXPECT_EQ(volts, slice_v);
  const Infrareds::Description& ring = *description.bodies[0].sensors<Infrareds>();
  EXPECT_NEAR(range_of(ring, volts[6]), 0.25, 1e-7);
  const double slanted = (0.5 - 0.25 * std::cos(exact::pi / 6)) / std::cos(exact::pi / 6);
  EXPECT_NEAR(range_of(ring, volts[8]), slanted, 1e-7);
  EXPECT_NEAR(range_of(ring, volts[0]), 0.8, 1e-7) << "over the sill";
}

}  // namespace
}  // namespace waitpoint::world
