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

// Drives a square of 4 m as in UMBmark, by the world's own motion; returns the final pose by dead reckoning.
Pose return_position(const OdometryErrors& errors, double sense) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].base.odometry = errors;
  const auto world = make_kinematic_world(description, 1);
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
    // turn_scale * 90 degrees: four equal chords, each turned against the previous one by phi. Their sum is a geometric
    // series.
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

// --- two wheels ------------------------------------------------------------------------------------------------------

// Drives UMBmark's square by the odometer, whose reading is exactly the square; returns the true final pose (Borenstein
// and Feng 1996). The motion that makes the wheels count `wanted` is linear in it.
Point true_return(const BaseDescription& base, double side_m, double sense) {
  Odometer odometer(base, 1, "robot");
  const OdometryErrors& e = base.odometry;
  const double scale = 0.5 * (e.wheel_diameter_ratio + 1);
  Pose truth;
  std::uint64_t step = 0;
  const auto drive = [&](double travel_m, double turn_rad, int steps) {
    const double across = 0.5 * base.axle_m * turn_rad / e.wheel_base_ratio;
    const double left = (travel_m - across) / scale, right = (travel_m + across) / scale * e.wheel_diameter_ratio;
    for (int i = 0; i < steps; ++i) {
      const Arc arc = {truth, 0.5 * (right + left) / steps, (right - left) / base.axle_m / steps};
      odometer.add(++step, 0.01, arc);
      truth = arc.end();
    }
  };
  for (int leg = 0; leg < 4; ++leg) {
    drive(side_m, 0, 800);
    drive(0, sense * 0.5 * exact::pi, 200);
  }
  EXPECT_NEAR(static_cast<double>(odometer.reading().travel_units) / e.units_per_m, 4 * side_m, 1e-5);
  EXPECT_NEAR(static_cast<double>(odometer.reading().turn_units) / e.units_per_rad, sense * 2 * exact::pi, 1e-5);
  return truth.position();
}

TEST(WheelOdometry, UmbmarkFindsTheDiametersAndTheBase) {
  const double side_m = 4;
  for (const auto& [diameters, wheel_base] : {std::pair(1.002, 1.0), {1.0, 1.005}, {1.001, 0.997}, {0.999, 1.004}}) {
    BaseDescription base = base_with(fine_units());
    base.kind = BaseDescription::Kind::differential;
    base.odometry.wheel_diameter_ratio = diameters;
    base.odometry.wheel_base_ratio = wheel_base;
    const Point clockwise = true_return(base, side_m, -1), counter = true_return(base, side_m, 1);
    // The article's first-order formulas.
    const double alpha = (clockwise.x + counter.x) / (-4 * side_m), beta = (clockwise.x - counter.x) / (-4 * side_m);
    const double half_axle = 0.5 * base.axle_m;
    const double across = std::sin(0.5 * beta) / (0.5 * side_m);  // 1 / radius of the legs
    EXPECT_NEAR((1 + across * half_axle) / (1 - across * half_axle), diameters, 3e-5);
    EXPECT_NEAR(0.5 * exact::pi / (0.5 * exact::pi - alpha), wheel_base, 5e-4);
  }
}

// Every wheel's travel is a random walk of variance k^2 a metre. To first order the covariance of (x, y, heading) is
// the sum over the motion of (F G) k^2 (F G)', with G the derivative of the pose there by the wheels and F that of the
// final pose by the pose there.
struct Covariance {
  double xx = 0, xy = 0, yy = 0, xh = 0, yh = 0, hh = 0;
};

Covariance closed_form(double distance_m, double turn_rad, double axle_m, double noise) {
  // On a straight line the sums are integrals over s from 0 to D, heading variance 2 k^2 / b^2 a metre.
  const double rate = 2 * noise * noise / (axle_m * axle_m);
  if (turn_rad == 0) {
    return {0.5 * noise * noise * distance_m,
            0,
            rate * distance_m * distance_m * distance_m / 3,
            0,
            0.5 * rate * distance_m * distance_m,
            rate * distance_m};
  }
  const double radius = distance_m / turn_rad;
  const Point end = {radius * std::sin(turn_rad), radius * (1 - std::cos(turn_rad))};
  Covariance sum;
  const int pieces = 20000;
  for (int i = 0; i < pieces; ++i) {
    const double heading = turn_rad * (i + 0.5) / pieces;
    const double dx = end.x - radius * std::sin(heading), dy = end.y - radius * (1 - std::cos(heading));
    for (const double side : {-1.0, 1.0}) {
      const double way = std::fabs(distance_m + side * 0.5 * axle_m * turn_rad) / pieces;
      const double variance = noise * noise * way, h = side / axle_m;
      const double x = 0.5 * std::cos(heading) - h * dy, y = 0.5 * std::sin(heading) + h * dx;
      sum.xx += variance * x * x;
      sum.xy += variance * x * y;
      sum.yy += variance * y * y;
      sum.xh += variance * x * h;
      sum.yh += variance * y * h;
      sum.hh += variance * h * h;
    }
  }
  return sum;
}

TEST(WheelOdometry, AMonteCarloCovarianceIsTheClosedFormOnALineAndOnAnArc) {
  const double distance_m = 3, noise = 0.002;
  const int runs = 20000, steps = 60;
  for (const double turn_rad : {0.0, 1.2}) {
    BaseDescription base = base_with(fine_units());
    base.kind = BaseDescription::Kind::differential;
    base.odometry.wheel_noise_m_per_sqrt_m = noise;
    const Pose end = Arc{{}, distance_m, turn_rad}.end();
    Covariance found;
    for (int run = 0; run < runs; ++run) {
      Odometer odometer(base, static_cast<std::uint64_t>(run), "robot");
      DeadReckoning reckoning(base.odometry);
      for (std::uint64_t step = 1; step <= steps; ++step) {
        odometer.add(step, 0.01, moved(distance_m / steps, turn_rad / steps));
        reckoning.take(odometer.reading());
      }
      const double x = reckoning.pose.x - end.x, y = reckoning.pose.y - end.y;
      const double h = exact::wrap_angle(reckoning.pose.heading - end.heading);
      found.xx += x * x / runs;
      found.xy += x * y / runs;
      found.yy += y * y / runs;
      found.xh += x * h / runs;
      found.yh += y * h / runs;
      found.hh += h * h / runs;
    }
    const Covariance expected = closed_form(distance_m, turn_rad, base.axle_m, noise);
    const auto near = [](double value, double wanted, double a, double b) {
      EXPECT_NEAR(value, wanted, 0.05 * std::max(std::fabs(wanted), 0.3 * std::sqrt(a * b)));
    };
    near(found.xx, expected.xx, expected.xx, expected.xx);
    near(found.yy, expected.yy, expected.yy, expected.yy);
    near(found.hh, expected.hh, expected.hh, expected.hh);
    near(found.xy, expected.xy, expected.xx, expected.yy);
    near(found.xh, expected.xh, expected.xx, expected.hh);
    near(found.yh, expected.yh, expected.yy, expected.hh);
  }
}

// The remainder of an encoder is uniform within half a tick: variance 1/12. Travel is the wheels' mean, turn their
// difference over the axle.
TEST(WheelOdometry, TicksAreOffByTheVarianceOfAUniformRest) {
  BaseDescription base = base_with(fine_units());
  base.kind = BaseDescription::Kind::differential;
  base.odometry.wheel_ticks_per_m = 500;
  Odometer odometer(base, 1, "robot");
  Draws draw(3);
  Moments travel, turn;
  double travelled = 0, turned = 0;
  for (std::uint64_t step = 1; step <= 40000; ++step) {
    const Arc arc = moved(draw(0, 0.02), draw(-0.05, 0.05));
    travelled += arc.distance_m;
    turned += arc.turn_rad;
    odometer.add(step, 0.01, arc);
    const double off_m = static_cast<double>(odometer.reading().travel_units) * 1e-9 - travelled;
    const double off_rad = static_cast<double>(odometer.reading().turn_units) * 1e-9 - turned;
    ASSERT_LE(std::fabs(off_m), 0.5 / 500 + 1e-6);
    ASSERT_LE(std::fabs(off_rad), 1 / 500.0 / base.axle_m + 1e-6);
    travel.add(off_m);
    turn.add(off_rad);
  }
  const double tick = 1 / (12 * 500.0 * 500.0);
  EXPECT_NEAR(travel.variance(), tick / 2, 0.05 * tick / 2);
  EXPECT_NEAR(turn.variance(), 2 * tick / (base.axle_m * base.axle_m), 0.05 * 2 * tick / (base.axle_m * base.axle_m));
}

// --- slip ------------------------------------------------------------------------------------------------------------

// A compound Poisson process: over D metres, mean r D m and variance 2 r D m^2 of the distance (each slip exponential
// with mean m), variance r D s^2 of the turn.
TEST(Odometer, SlipsHaveTheMomentsOfACompoundPoissonProcess) {
  OdometryErrors errors = fine_units();
  errors.slips_per_m = 0.7;
  errors.slip_m = 0.05;
  errors.slip_turn_rad = 0.1;
  const double distance = 4;
  const int runs = 20000;
  for (const int steps : {8, 50}) {
    for (const double sense : {1.0, -1.0}) {
      Moments travel, turn;
      for (int run = 0; run < runs; ++run) {
        Odometer odometer(base_with(errors), static_cast<std::uint64_t>(run), "robot");
        for (std::uint64_t step = 1; step <= static_cast<std::uint64_t>(steps); ++step)
          odometer.add(step, 0.01, moved(sense * distance / steps, 0));
        travel.add(sense * static_cast<double>(odometer.reading().travel_units) * 1e-9 - distance);
        turn.add(static_cast<double>(odometer.reading().turn_units) * 1e-9);
      }
      const double expected = 0.7 * distance;
      EXPECT_NEAR(travel.mean(), expected * 0.05, 0.03 * expected * 0.05);
      EXPECT_NEAR(travel.variance(), expected * 2 * 0.05 * 0.05, 0.05 * expected * 2 * 0.05 * 0.05);
      EXPECT_NEAR(turn.mean(), 0, 4 * 0.1 * std::sqrt(expected / runs));
      EXPECT_NEAR(turn.variance(), expected * 0.1 * 0.1, 0.05 * expected * 0.1 * 0.1);
    }
  }
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
