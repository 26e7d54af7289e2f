// SPDX-License-Identifier: BSD-3-Clause
// The optical flow sensor against the geometry in world/sensors/optical_flow.hpp.
#include "world/sensors/optical_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/world/scenes.hpp"
#include "tests/world/sensors/statistics.hpp"

namespace waitpoint::world {
namespace {

const Duration flow_step = std::chrono::milliseconds(10);

/// The readings of a body that makes the same motion in every step.
std::vector<OpticalFlow::Reading> flow_readings(const OpticalFlow::Description& description, const Arc& arc, int steps,
                                                double height_m = 0) {
  OpticalFlow::Model sensor(description, 1, "robot");
  BodyState body;
  body.arc = arc;
  body.height_m = height_m;
  std::vector<OpticalFlow::Reading> all;
  for (int i = 1; i <= steps; ++i) {
    sensor.moved({i * flow_step, flow_step}, body);
    if (all.empty() || all.back().number != sensor.reading().number) all.push_back(sensor.reading());
  }
  return all;
}

struct Sums {
  std::int64_t ahead = 0, left = 0;
};

Sums sums_of(const std::vector<OpticalFlow::Reading>& all) {
  Sums sums;
  for (const OpticalFlow::Reading& reading : all) {
    sums.ahead += reading.ahead_counts;
    sums.left += reading.left_counts;
  }
  return sums;
}

Arc motion(double distance_m, double turn_rad = 0, double side_m = 0) {
  Arc arc;
  arc.distance_m = distance_m;
  arc.turn_rad = turn_rad;
  arc.side_m = side_m;
  return arc;
}

TEST(OpticalFlow, CountsTheWayByTheHeightWithoutLosingParts) {
  // 1.23 mm a step at 0.1 m are 4.7 counts; a metre and 23 cm in 1 000 steps.
  const Sums sums = sums_of(flow_readings({}, motion(0.00123), 1000));
  EXPECT_EQ(sums.ahead, std::llround(1.23 / 0.1 * 385));
  EXPECT_EQ(sums.left, 0);
}

TEST(OpticalFlow, ABodyInTheAirSeesTheFloorMoveLess) {
  const Sums sums = sums_of(flow_readings({}, motion(0.01, 0, 0.02), 100, 0.9));
  EXPECT_EQ(sums.ahead, 385);
  EXPECT_EQ(sums.left, 770);
}

TEST(OpticalFlow, ATurnMovesOnlyALensBesideTheCentreAndCountsAreInItsOwnFrame) {
  EXPECT_EQ(sums_of(flow_readings({}, motion(0, 0.005), 100)).ahead, 0);
  const Sums ahead = sums_of(flow_readings({.mount = {0.1, 0, 0}}, motion(0, 0.01), 100));
  EXPECT_EQ(ahead.ahead, 0);
  EXPECT_EQ(ahead.left, 385);
  const Sums turned = sums_of(flow_readings({.mount = {0, 0, exact::pi / 2}}, motion(0.001), 100));
  EXPECT_EQ(turned.ahead, 0);
  EXPECT_EQ(turned.left, -385);
}

TEST(OpticalFlow, IsLostTooFastTooNearAndWithoutTexture) {
  // 7.4 rad/s at 0.1 m are 0.74 m/s.
  EXPECT_TRUE(flow_readings({}, motion(0.0073), 1).back().tracked);
  const OpticalFlow::Reading lost = flow_readings({}, motion(0.0075), 1).back();
  EXPECT_FALSE(lost.tracked);
  EXPECT_EQ(lost.ahead_counts, 0);
  EXPECT_FALSE(flow_readings({.mount = {}, .height_m = 0.07}, motion(0.001), 1).back().tracked);
  int tracked = 0;
  for (const OpticalFlow::Reading& reading : flow_readings({.mount = {}, .dropout = 0.25}, motion(0.001), 10'000))
    tracked += reading.tracked ? 1 : 0;
  EXPECT_NEAR(tracked, 7500, 4 * std::sqrt(10'000 * 0.25 * 0.75));
}

TEST(OpticalFlow, NoiseAndScaleAreThoseOfItsKeys) {
  std::vector<double> ahead;
  for (const OpticalFlow::Reading& reading :
       flow_readings({.mount = {}, .scale = 1.1, .noise_counts = 3}, motion(0.002), 40'000))
    ahead.push_back(reading.ahead_counts);
  const Statistics counts = statistics_of(ahead);
  EXPECT_NEAR(counts.mean, 1.1 * 0.002 / 0.1 * 385, 4 * 3 / std::sqrt(40'000.0));
  EXPECT_NEAR(counts.deviation, 3, 0.2);
}

TEST(OpticalFlow, ReadingsOfAWorldComeAtItsPeriod) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].sensors<OpticalFlow>() = OpticalFlow::Description{.mount = {}, .period = 2 * flow_step};
  const auto world = make_kinematic_world(description, 1);
  EXPECT_EQ(reading<OpticalFlow>(*world).number, 0u);
  world->command(BodyId(0), {0.1, 0});
  for (int i = 0; i < 100; ++i) world->step();
  const OpticalFlow::Reading last = reading<OpticalFlow>(*world);
  EXPECT_EQ(last.number, 50u);
  EXPECT_NEAR(last.ahead_counts, 0.002 / 0.1 * 385, 1);
}

}  // namespace
}  // namespace waitpoint::world
