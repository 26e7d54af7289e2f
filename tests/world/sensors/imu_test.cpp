// SPDX-License-Identifier: BSD-3-Clause
// Inertial sensors: their measurements of a motion, and their errors against the closed forms in world/sensors/imu.hpp.
#include "world/sensors/imu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/world/scenes.hpp"
#include "tests/world/sensors/statistics.hpp"

namespace waitpoint::world {
namespace {

const Duration step = std::chrono::milliseconds(10);

/// Samples of a unit at rest, one a step.
class Standing {
 public:
  Standing(const Imu::Description& description, std::uint64_t seed) : imu_(description, seed, "robot") {}
  const Imu::Reading& next() {
    now_ += step;
    imu_.moved({now_, step}, BodyState());
    return imu_.reading();
  }

 private:
  Imu::Model imu_;
  Duration now_;
};

/// A body that has turned by that in a step.
BodyState turned(double turn_rad) {
  BodyState body;
  body.arc.turn_rad = turn_rad;
  return body;
}

Imu::Description with_gyro(const InertialErrors& errors) {
  Imu::Description description;
  description.gyro = errors;
  description.period = step;
  return description;
}

double variance_of(const std::vector<double>& values, double mean) {
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size());
}

TEST(Imu, MeasuresTurnAccelerationAndWhatACurveAndGravityTake) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].base.v_acceleration_m_s2 = 2;
  description.bodies[0].sensors<Imu>() = Imu::Description{};
  const auto world = make_kinematic_world(description, 1);
  EXPECT_EQ(reading<Imu>(*world).number, 0u);
  world->command(BodyId(0), {0.5, 0});
  world->step();
  Imu::Reading sample = reading<Imu>(*world);
  EXPECT_EQ(sample.number, 1u);
  EXPECT_NEAR(sample.ahead_m_s2, 2, 1e-9);
  EXPECT_NEAR(sample.up_m_s2, gravity_m_s2, 1e-9);
  for (int i = 0; i < 100; ++i) world->step();
  world->command(BodyId(0), {0.5, 0.8});
  for (int i = 0; i < 100; ++i) world->step();
  sample = reading<Imu>(*world);
  EXPECT_NEAR(sample.turn_rad_s, 0.8, 1e-9);
  EXPECT_NEAR(sample.left_m_s2, 0.5 * 0.8, 1e-9);
  EXPECT_NEAR(sample.ahead_m_s2, 0, 1e-9);
  EXPECT_NEAR(sample.turned_rad, 0.8 * 1, 1e-9);
}

TEST(Imu, ASampleIsTheMeanOverItsPeriod) {
  Imu::Description description;
  description.period = 5 * step;
  Imu::Model imu(description, 1, "robot");
  for (int i = 1; i <= 10; ++i) {
    imu.moved({i * step, step}, turned(0.001 * i));
    EXPECT_EQ(imu.reading().number, static_cast<std::uint64_t>(i / 5));
  }
  EXPECT_NEAR(imu.reading().turn_rad_s, 0.001 * (6 + 7 + 8 + 9 + 10) / 0.05, 1e-12);
  EXPECT_NEAR(imu.reading().turned_rad, 0.055, 1e-12);
}

TEST(Imu, IsExactWithoutKeysAndScaledBoundedAndQuantisedWithThem) {
  Standing exact_one(Imu::Description{}, 1);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(exact_one.next().turn_rad_s, 0);
  const auto reading = [](const InertialErrors& errors, double turn_rad_s) {
    Imu::Model imu(with_gyro(errors), 1, "robot");
    imu.moved({step, step}, turned(turn_rad_s * step.seconds()));
    return imu.reading().turn_rad_s;
  };
  EXPECT_NEAR(reading({.scale = 1.02}, 0.5), 0.51, 1e-12);
  EXPECT_EQ(reading({.max = 4}, -5), -4);
  EXPECT_NEAR(reading({.resolution = 0.01}, 0.1234), 0.12, 1e-12);
}

// The variance over 12 800 units has a standard deviation of 1.25 %: 5 % are four of them.
TEST(Imu, TheAngleOfAnIntegratedGyroHasTheVarianceOfItsErrors) {
  constexpr int units = 12800, samples = 200;
  const double t = samples * step.seconds();
  const double n = 0.01, b = 0.008, k = 0.01, d = 0.01, tau = 0.5;
  const struct {
    InertialErrors errors;
    double variance;
  } cases[] = {
      {{.noise_per_sqrt_hz = n}, n * n * t},
      {{.bias = b}, b * b * t * t},
      {{.walk_per_sqrt_s = k}, k * k * t * t * t / 3},
      {{.drift = d, .drift_s = tau}, 2 * d * d * tau * (t - tau * (1 - std::exp(-t / tau)))},
      {{.noise_per_sqrt_hz = n, .bias = b, .walk_per_sqrt_s = k, .drift = d, .drift_s = tau},
       n * n * t + b * b * t * t + k * k * t * t * t / 3 + 2 * d * d * tau * (t - tau * (1 - std::exp(-t / tau)))}};
  for (const auto& each : cases) {
    std::vector<double> angles;
    for (std::uint64_t seed = 0; seed < units; ++seed) {
      Standing imu(with_gyro(each.errors), seed);
      for (int i = 1; i < samples; ++i) imu.next();
      angles.push_back(imu.next().turned_rad);
    }
    EXPECT_NEAR(variance_of(angles, 0) / each.variance, 1, 0.05);
    EXPECT_NEAR(statistics_of(angles).mean, 0, 4 * std::sqrt(each.variance / units));
  }
}

TEST(Imu, ALongRecordHasTheAllanVarianceOfItsErrors) {
  const double n = 0.002, k = 0.0005, d = 0.004, tau = 1;
  Standing imu(with_gyro({.noise_per_sqrt_hz = n, .walk_per_sqrt_s = k, .drift = d, .drift_s = tau}), 3);
  std::vector<double> turned = {0};  // at every step: a mean over m of them is a difference
  for (int i = 0; i < 2'000'000; ++i) turned.push_back(imu.next().turned_rad);
  for (const std::size_t m : {2u, 10u, 100u, 300u, 1000u}) {
    const double t = static_cast<double>(m) * step.seconds();
    double squares = 0;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i + 2 * m < turned.size(); i += m) {
      const double change = (turned[i + 2 * m] - 2 * turned[i + m] + turned[i]) / t;
      squares += change * change;
      ++pairs;
    }
    const double measured = squares / static_cast<double>(2 * pairs);
    const double wandering =
        2 * d * d * tau / t * (1 - tau / (2 * t) * (3 - 4 * std::exp(-t / tau) + std::exp(-2 * t / tau)));
    const double expected = n * n / t + k * k * t / 3 + wandering;
    EXPECT_NEAR(measured / expected, 1, 4 * std::sqrt(3.0 / static_cast<double>(pairs)) + 0.005) << t << " s";
  }
}

TEST(Imu, AxesRobotsAndErrorsHaveStreamsOfTheirOwn) {
  Imu::Description noisy;
  noisy.gyro.noise_per_sqrt_hz = noisy.accelerometer.noise_per_sqrt_hz = 1;
  noisy.period = step;
  Standing one(noisy, 1);
  const Imu::Reading sample = one.next();
  const std::vector<double> drawn = {sample.turn_rad_s, sample.ahead_m_s2, sample.left_m_s2,
                                     sample.up_m_s2 - gravity_m_s2};
  for (std::size_t i = 0; i < drawn.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(std::fabs(drawn[i] - drawn[j]), 1e-6);
  noisy.gyro.bias = 0.5;  // an additional error does not change the draws of the others
  const double bias = 0.5 * RandomStream(1, "robot", "imu.gyro.bias").normal(0);
  EXPECT_NEAR(Standing(noisy, 1).next().turn_rad_s, sample.turn_rad_s + bias, 1e-12);
}

}  // namespace
}  // namespace waitpoint::world
