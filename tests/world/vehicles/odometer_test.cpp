// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/odometer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

OdometryErrors fine_units() {
  OdometryErrors errors;
  errors.units_per_m = errors.units_per_rad = 1e9;
  return errors;
}

BaseDescription base_with(const OdometryErrors& errors) {
  BaseDescription base;
  base.odometry = errors;
  return base;
}

Arc moved(double distance_m, double turn_rad) { return {{}, distance_m, turn_rad}; }

// Dead reckoning from the counted units alone.
class DeadReckoning {
 public:
  explicit DeadReckoning(const OdometryErrors& errors) : errors_(errors) {}

  void take(const OdometerReading& reading) {
    const Arc arc = {pose, static_cast<double>(reading.travel_units - travel_) / errors_.units_per_m,
                     static_cast<double>(reading.turn_units - turn_) / errors_.units_per_rad};
    travel_ = reading.travel_units;
    turn_ = reading.turn_units;
    pose = arc.end();
  }
  Pose pose;

 private:
  OdometryErrors errors_;
  std::int64_t travel_ = 0, turn_ = 0;
};

// Drives a square of 4 m as in UMBmark, by the world's own motion, and says where dead reckoning thinks it came back
// to.
Pose return_position(const OdometryErrors& errors, double sense) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].base.odometry = errors;
  const auto world = make_fcl_world(description, 1);
  DeadReckoning reckoning(errors);
  const auto drive = [&](Velocity velocity, int steps) {
    world->command(BodyId(0), velocity);
    for (int i = 0; i < steps; ++i) {
      world->step();
      reckoning.take(world->odometer(BodyId(0)));
    }
  };
  for (int leg = 0; leg < 4; ++leg) {
    drive({0.5, 0}, 800);
    drive({0, sense * 0.5 * exact::pi}, 100);
  }
  EXPECT_NEAR(length(world->body(BodyId(0)).pose.position()), 0, 1e-9) << "the truth does come back";
  return reckoning.pose;
}

TEST(Odometer, SystematicErrorsReturnWhereUmbmarkSays) {
  const double travel_scale = 1.004, turn_scale = 0.985, drift = 0.006, side = 4;
  OdometryErrors errors = fine_units();
  errors.travel_scale = travel_scale;
  errors.turn_scale = turn_scale;
  errors.drift_rad_per_m = drift;
  for (const double sense : {1.0, -1.0}) {
    // Each leg is measured as an arc of length travel_scale * side that turns by drift * side, each corner as
    // turn_scale
    // * 90 degrees: four equal chords, each turned against the one before by phi. Their sum is a geometric series.
    const double leg_turn = drift * side, phi = leg_turn + sense * turn_scale * exact::pi / 2;
    const double chord = travel_scale * side * std::sin(leg_turn / 2) / (leg_turn / 2);
    const double sum = chord * std::sin(2 * phi) / std::sin(phi / 2), direction = leg_turn / 2 + 1.5 * phi;
    const Pose back = return_position(errors, sense);
    EXPECT_NEAR(back.x, sum * std::cos(direction), 1e-5);
    EXPECT_NEAR(back.y, sum * std::sin(direction), 1e-5);
    EXPECT_NEAR(exact::wrap_angle(back.heading - 4 * phi), 0, 1e-5);
  }
}

TEST(Odometer, QuantisationNeverLosesMoreThanHalfAUnit) {
  OdometryErrors errors;
  errors.units_per_m = 1000;
  errors.units_per_rad = 100;
  Odometer odometer(base_with(errors), 1, "robot");
  Draws draw(2);
  double travelled = 0, turned = 0;
  for (std::uint64_t step = 1; step <= 20000; ++step) {
    const double distance = draw(-0.002, 0.004), turn = draw(-0.02, 0.01);
    odometer.add(step, 0.01, moved(distance, turn));
    travelled += distance;
    turned += turn;
    ASSERT_NEAR(static_cast<double>(odometer.reading().travel_units), 1000 * travelled, 0.5 + 1e-6);
    ASSERT_NEAR(static_cast<double>(odometer.reading().turn_units), 100 * turned, 0.5 + 1e-6);
  }
}

struct Moments {
  double sum = 0, squares = 0, count = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++count;
  }
  double mean() const { return sum / count; }
  double variance() const { return squares / count - mean() * mean(); }
};

TEST(Odometer, RandomErrorsHaveTheVariancesOfARandomWalk) {
  OdometryErrors errors = fine_units();
  errors.travel_noise_m_per_sqrt_m = 0.03;
  errors.turn_noise_rad_per_sqrt_m = 0.02;
  errors.turn_noise_rad_per_sqrt_rad = 0.05;
  const double distance = 3, turn = 0.8;
  const int steps = 25, runs = 20000;
  const double turn_variance = 0.02 * 0.02 * distance + 0.05 * 0.05 * turn;
  Moments travel, heading, sideways_straight;
  for (int run = 0; run < runs; ++run) {
    Odometer on_arc(base_with(errors), static_cast<std::uint64_t>(run), "arc"),
        straight(base_with(errors), static_cast<std::uint64_t>(run), "straight");
    DeadReckoning reckoning(errors);
    for (std::uint64_t step = 1; step <= steps; ++step) {
      on_arc.add(step, 0.01, moved(distance / steps, turn / steps));
      straight.add(step, 0.01, moved(distance / steps, 0));
      reckoning.take(straight.reading());
    }
    travel.add(static_cast<double>(on_arc.reading().travel_units) * 1e-9 - distance);
    heading.add(static_cast<double>(on_arc.reading().turn_units) * 1e-9 - turn);
    sideways_straight.add(reckoning.pose.y);
  }
  EXPECT_NEAR(travel.variance(), 0.03 * 0.03 * distance, 0.05 * 0.03 * 0.03 * distance);
  EXPECT_NEAR(travel.mean(), 0, 4 * 0.03 * std::sqrt(distance / runs));
  EXPECT_NEAR(heading.variance(), turn_variance, 0.05 * turn_variance);
  EXPECT_NEAR(heading.mean(), 0, 4 * std::sqrt(turn_variance / runs));
  // The heading is a random walk along the line; its integral has the variance k^2 D^3 / 3.
  const double sideways = 0.02 * 0.02 * distance * distance * distance / 3;
  EXPECT_NEAR(sideways_straight.variance(), sideways, 0.05 * sideways);
}

TEST(Odometer, CountsWhatAnOmniBaseGoesSideways) {
  OdometryErrors errors = fine_units();
  errors.travel_scale = 1.02;
  errors.travel_noise_m_per_sqrt_m = 0.01;
  Moments side;
  for (int run = 0; run < 5000; ++run) {
    Odometer odometer(base_with(errors), static_cast<std::uint64_t>(run), "robot");
    for (std::uint64_t step = 1; step <= 10; ++step) odometer.add(step, 0.01, {{}, 0, 0, -0.2});
    side.add(static_cast<double>(odometer.reading().side_units) * 1e-9);
    EXPECT_EQ(odometer.reading().travel_units, 0);
  }
  EXPECT_NEAR(side.mean(), -2.04, 4 * 0.01 * std::sqrt(2.0 / 5000));
  EXPECT_NEAR(side.variance(), 0.01 * 0.01 * 2, 0.05 * 0.01 * 0.01 * 2);
}

TEST(Odometer, VelocityIsMeasuredAndStandingCountsNothing) {
  OdometryErrors errors;
  errors.travel_scale = 1.01;
  Odometer odometer(base_with(errors), 1, "robot");
  odometer.add(1, 0.01, moved(0.005, -0.01));
  EXPECT_NEAR(odometer.reading().velocity.v_m_s, 0.505, 1e-12);
  EXPECT_NEAR(odometer.reading().velocity.w_rad_s, -1, 1e-12);
  const auto units = odometer.reading().travel_units;
  odometer.add(2, 0.01, moved(0, 0));
  EXPECT_EQ(odometer.reading().velocity, (Velocity{}));
  EXPECT_EQ(odometer.reading().travel_units, units);
}

}  // namespace
}  // namespace waitpoint::world
