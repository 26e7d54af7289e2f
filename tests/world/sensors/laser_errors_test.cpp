// SPDX-License-Identifier: BSD-3-Clause
// A laser's errors that depend on the surfaces hit by its beam, against their closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/world/scenes.hpp"
#include "tests/world/sensors/statistics.hpp"

namespace waitpoint::world {
namespace {

// One beam at `heading`, a line without errors.
LaserDescription single_beam(double heading) {
  LaserDescription laser = perfect_laser(0.4);
  laser.beams = 1;
  laser.field_of_view_rad = 0;
  laser.mount.heading = heading;
  return laser;
}

WorldDescription world_of(const std::vector<Shape>& shapes, const LaserDescription& laser) {
  WorldDescription description;
  for (const Shape& shape : shapes)
    description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, true});
  description.bodies.push_back(nimble_body("robot", cylinder({0, 0}, 0.2), {0, 0, 0}));
  description.bodies[0].sensors<Lasers>().push_back(laser);
  return description;
}

std::vector<double> ranges_of(const std::vector<Shape>& shapes, const LaserDescription& laser, int scans) {
  const auto world = make_kinematic_world(world_of(shapes, laser), 1);
  std::vector<double> ranges;
  LaserScan scan;
  for (int i = 1; i <= scans; ++i) {
    world->scan(BodyId(0), 0, static_cast<std::uint64_t>(i), scan);
    ranges.insert(ranges.end(), scan.range_m.begin(), scan.range_m.end());
  }
  return ranges;
}

const Shape wall = box({5.5, 0, 0}, 1, 200);  // its face at x = 5

TEST(LaserErrors, AngleNoiseActsByRangeTimesTheTangentOfIncidence) {
  for (const double incidence : {0.3, 1.0}) {
    LaserDescription laser = single_beam(incidence);
    laser.angle_noise_rad = 0.001;
    const Statistics s = statistics_of(ranges_of({wall}, laser, 20000));
    const double range = 5 / std::cos(incidence), expected = range * std::tan(incidence) * 0.001;
    EXPECT_NEAR(s.deviation, expected, 0.02 * expected);
    EXPECT_NEAR(s.mean, range, 4 * expected / std::sqrt(20000.0) + range * 1e-5);
  }
}

TEST(LaserErrors, ASpotOnTwoSurfacesReadsUniformlyBetweenThem) {
  LaserDescription laser = single_beam(0);
  laser.spot_m = 0.008;
  laser.spot_divergence_rad = 0.015;
  // The near box ends 1 mm beside the beam; the spot is 83 mm wide at the wall.
  const std::vector<Shape> scene = {wall, box({2.5, -1.001, 0}, 1, 2)};
  const std::vector<double> ranges = ranges_of(scene, laser, 20000);
  const Statistics s = statistics_of(ranges);
  EXPECT_NEAR(s.mean, 3.5, 4 * 3 / std::sqrt(12.0 * 20000));
  EXPECT_NEAR(s.deviation, 3 / std::sqrt(12.0), 0.02 * 3 / std::sqrt(12.0));
  for (const double range : ranges) {
    EXPECT_GE(range, 2);
    EXPECT_LE(range, 5.001);
  }
  laser.spot_m = laser.spot_divergence_rad = 0;
  EXPECT_NEAR(ranges_of(scene, laser, 1)[0], 5, 1e-9) << "a line passes the edge";
}

TEST(LaserErrors, ASpotOnOneSurfaceOrHalfInTheVoidReadsTheSurface) {
  LaserDescription laser = single_beam(0);
  laser.spot_m = 0.008;
  laser.spot_divergence_rad = 0.015;
  EXPECT_NEAR(ranges_of({wall}, laser, 1)[0], 5, 1e-9);
  const Shape step = box({4.9, -1.001, 0}, 1, 2);  // 0.6 m thick before the wall, its face at x = 4.4
  laser.mixed_jump_m = 0.7;
  EXPECT_NEAR(ranges_of({wall, step}, laser, 1)[0], 5, 1e-9) << "the jump is not far enough";
  EXPECT_NEAR(ranges_of({step}, laser, 1)[0], 4.4, 1e-3) << "what half the light falls on";
}

TEST(LaserErrors, SurfacesMetTooFlatlySendNoEcho) {
  for (const double spot_m : {0.0, 0.008}) {
    LaserDescription laser = perfect_laser(0.4);
    laser.field_of_view_rad = 2 * radians_of_degrees(85);
    laser.beams = 171;  // each degree
    laser.incidence_max_rad = radians_of_degrees(70.5);
    laser.spot_m = spot_m;
    laser.range_max_m = 80;
    const std::vector<double> ranges = ranges_of({wall}, laser, 1);
    for (int i = 0; i <= 170; ++i) {
      const int incidence = std::abs(i - 85);
      const double expected = incidence <= 70 ? 5 / std::cos(radians_of_degrees(incidence)) : 80;
      EXPECT_NEAR(ranges[static_cast<std::size_t>(i)], expected, 1e-6) << incidence << " degrees, spot " << spot_m;
    }
  }
}

TEST(LaserErrors, SoManyEchoesAreLost) {
  LaserDescription laser = perfect_laser(0.4);
  laser.dropout = 0.05;
  laser.range_max_m = 200;
  const std::vector<double> ranges = ranges_of({wall, box({0, 5.5, 0}, 20, 1), box({0, -5.5, 0}, 20, 1)}, laser, 200);
  double seen = 0, lost = 0;
  for (const double range : ranges) (range == 200 ? lost : seen) += 1;
  const double count = seen + lost;
  EXPECT_NEAR(lost / count, 0.05, 4 * std::sqrt(0.05 * 0.95 / count));
}

TEST(LaserErrors, TheBiasOfAColdDeviceFadesExponentially) {
  LaserDescription laser = single_beam(0);
  laser.range_bias_m = 0.002;
  laser.warm_up_bias_m = 0.02;
  laser.warm_up_s = 0.5;
  const auto world = make_kinematic_world(world_of({wall}, laser), 1);
  LaserScan scan;
  for (int step = 0; step <= 200; ++step) {
    world->scan(BodyId(0), 0, 1, scan);
    EXPECT_NEAR(scan.range_m[0], 5.002 + 0.02 * std::exp(-step * 0.01 / 0.5), 1e-9);
    world->step();
  }
}

}  // namespace
}  // namespace waitpoint::world
