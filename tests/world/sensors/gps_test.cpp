// SPDX-License-Identifier: BSD-3-Clause
// A satellite receiver: its errors against the closed forms in world/sensors/gps.hpp.
#include "world/sensors/gps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/world/scenes.hpp"
#include "tests/world/sensors/statistics.hpp"

namespace waitpoint::world {
namespace {

const Duration second = std::chrono::seconds(1);
constexpr int fixes = 400'000;

/// The x positions, or those of another axis, of a receiver at rest at (2, -1), 5 m high, with a fix a second.
std::vector<double> record(const Gps::Description& description, char axis = 'x') {
  Gps::Model receiver(description, 1, "robot");
  std::vector<double> values;
  BodyState body;
  body.pose = {2, -1, 0};
  body.height_m = 5;
  for (int i = 1; i <= fixes; ++i) {
    receiver.moved({i * second, second}, body);
    const Gps::Reading& fix = receiver.reading();
    values.push_back(axis == 'x' ? fix.position.x : axis == 'y' ? fix.position.y : fix.height_m);
  }
  return values;
}

TEST(Gps, IsRightUpToItsResolutionWithoutKeysAndGivesItsAntennaAtItsTimes) {
  WorldDescription description;
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {2, 3, exact::pi / 2}));
  description.bodies[0].sensors<Gps>() =
      Gps::Description{.antenna = {0.3, 0.1}, .period = std::chrono::milliseconds(500)};
  const auto world = make_kinematic_world(description, 1);
  for (int i = 1; i <= 49; ++i) world->step();
  EXPECT_EQ(reading<Gps>(*world).number, 0u);
  world->step();
  EXPECT_EQ(reading<Gps>(*world).number, 1u);
  EXPECT_NEAR(reading<Gps>(*world).position.x, 2 - 0.1, 0.005 + 1e-9);
  EXPECT_NEAR(reading<Gps>(*world).position.y, 3 + 0.3, 0.005 + 1e-9);
}

TEST(Gps, BiasAndNoiseAreThoseOfItsKeys) {
  Gps::Description description = {.bias_x_m = 1.5, .bias_y_m = -0.5, .noise_m = 0.4, .resolution_m = 0};
  const Statistics x = statistics_of(record(description)), y = statistics_of(record(description, 'y'));
  const double mean_error = 4 * 0.4 / std::sqrt(fixes);
  EXPECT_NEAR(x.mean, 3.5, mean_error);
  EXPECT_NEAR(y.mean, -1.5, mean_error);
  EXPECT_NEAR(x.deviation, 0.4, 0.004);
  EXPECT_NEAR(y.deviation, 0.4, 0.004);
  const Statistics height = statistics_of(record(description, 'h'));
  EXPECT_NEAR(height.mean, 5, 1.5 * mean_error);
  EXPECT_NEAR(height.deviation, 0.6, 0.006);
}

// About fixes / (2 tau) of the differences are independent: the standard deviation of their variance is 1.5 %.
TEST(Gps, FixesThatAreApartDifferByWhatHasWanderedOff) {
  const double drift = 2, tau = 20, noise = 0.3;
  const std::vector<double> x = record({.drift_m = drift, .drift_s = tau, .noise_m = noise, .resolution_m = 0});
  for (const std::size_t apart : {1u, 5u, 20u, 60u}) {
    double squares = 0;
    for (std::size_t i = 0; i + apart < x.size(); ++i) squares += (x[i + apart] - x[i]) * (x[i + apart] - x[i]);
    const double measured = squares / static_cast<double>(x.size() - apart);
    const double expected = 2 * drift * drift * (1 - std::exp(-static_cast<double>(apart) / tau)) + 2 * noise * noise;
    EXPECT_NEAR(measured / expected, 1, 0.06) << apart << " s";
  }
  EXPECT_NEAR(statistics_of(x).deviation, std::sqrt(drift * drift + noise * noise), 0.03 * drift);
}

TEST(Gps, SoManyFixesFail) {
  Gps::Model receiver({.dropout = 0.1}, 1, "robot");
  for (int i = 1; i <= fixes; ++i) receiver.moved({i * second, second}, BodyState());
  EXPECT_NEAR(static_cast<double>(receiver.reading().number) / fixes, 0.9, 4 * std::sqrt(0.1 * 0.9 / fixes));
}

TEST(Gps, ADropoutChangesNoOtherFix) {
  Gps::Description sure = {.drift_m = 1, .noise_m = 1}, failing = sure;
  failing.dropout = 0.5;
  Gps::Model a(sure, 1, "robot"), b(failing, 1, "robot");
  std::uint64_t seen = 0;
  for (int i = 1; i <= 100; ++i) {
    a.moved({i * second, second}, BodyState());
    b.moved({i * second, second}, BodyState());
    if (b.reading().number == seen) continue;
    seen = b.reading().number;
    EXPECT_EQ(a.reading().position, b.reading().position);
  }
  EXPECT_GT(seen, 20u);
  EXPECT_LT(seen, 80u);
}

}  // namespace
}  // namespace waitpoint::world
