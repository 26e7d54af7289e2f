// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/segment_map_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/random.hpp"
#include "modules/genom/settings.hpp"
#include "tests/modules/segloc/tour.hpp"

namespace waitpoint::segloc {
namespace {

PoseEstimate at(const Pose& pose, double variance = 1e-6) {
  PoseEstimate e{pose, {}};
  e.covariance[0] = e.covariance[4] = e.covariance[8] = variance;
  return e;
}

// The wall from a to b as an ideal segment for a robot at `robot`; a to b is counter-clockwise seen from there.
posters::Segment seen(const Pose& robot, Point a, Point b) {
  posters::Segment s;
  s.start = between(robot, {a.x, a.y, 0}).position();
  s.end = between(robot, {b.x, b.y, 0}).position();
  const Point along = (1.0 / length(s.end - s.start)) * (s.end - s.start);
  const Point normal{along.y, -along.x};
  s.distance_m = dot(normal, s.start);
  s.normal_rad = exact::atan2(normal.y, normal.x);
  s.covariance = {1e-5, 0, 1e-5};
  s.points = 50;
  return s;
}

posters::Segments room_seen(const Pose& robot) {
  posters::Segments segments;
  segments.items.push_back(seen(robot, {4, -3}, {4, 3}));
  segments.items.push_back(seen(robot, {4, 3}, {-4, 3}));
  segments.items.push_back(seen(robot, {-4, -3}, {4, -3}));
  return segments;
}

// Factors P; false where it is not positive definite.
bool is_positive(const Covariance& p) {
  std::vector<double> l(p.size() * p.size(), 0.0);
  const auto at = [&](std::size_t i, std::size_t j) -> double& { return l[i * p.size() + j]; };
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double v = p(i, j);
      for (std::size_t k = 0; k < j; ++k) v -= at(i, k) * at(j, k);
      if (i == j && !(v > 0)) return false;
      at(i, j) = i == j ? std::sqrt(v) : v / at(j, j);
    }
  }
  return true;
}

TEST(SegmentMapFilter, PredictionMovesThePoseAndItsCovarianceAsSampledMotionsDo) {
  Parameters parameters;
  parameters.travel_noise_m_per_sqrt_m = 0.05;
  parameters.drift_noise_rad_per_sqrt_m = 0.03;
  parameters.turn_noise_rad_per_sqrt_rad = 0.02;
  parameters.travel_scale_deviation = parameters.turn_scale_deviation = parameters.drift_deviation_rad_per_m = 0;
  PoseEstimate start = at({1, 2, 0.7}, 0);
  start.covariance = {0.01, 0.002, 0.001, 0.002, 0.02, -0.001, 0.001, -0.001, 0.002};
  SegmentMapFilter filter(parameters, start);
  const PoseEstimate motion{{0.8, 0.1, 0.4}, {0.003, 0.001, 0, 0.001, 0.002, 0.0005, 0, 0.0005, 0.001}};
  filter.predict(motion);
  const PoseEstimate after = filter.position();
  const Pose expected = compose(start.pose, motion.pose);
  EXPECT_NEAR(after.pose.x, expected.x, 1e-12);
  EXPECT_NEAR(after.pose.heading, expected.heading, 1e-12);

  // F P F' + B Q B' by finite differences of compose().
  std::array<double, 9> q = motion.covariance;
  const double way = length(motion.pose.position());
  q[0] += 0.05 * 0.05 * way;
  q[4] += 0.05 * 0.05 * way;
  q[8] += 0.03 * 0.03 * way + 0.02 * 0.02 * 0.4;
  const double h = 1e-6;
  double j[3][6];
  for (int k = 0; k < 6; ++k) {
    Pose a = start.pose, b = motion.pose;
    double* moved[6] = {&a.x, &a.y, &a.heading, &b.x, &b.y, &b.heading};
    *moved[k] += h;
    const Pose c = compose(a, b);
    j[0][k] = (c.x - expected.x) / h;
    j[1][k] = (c.y - expected.y) / h;
    j[2][k] = (c.heading - expected.heading) / h;
  }
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t l = 0; l < 3; ++l) {
          sum += j[r][k] * j[c][l] * start.covariance[3 * k + l] + j[r][k + 3] * j[c][l + 3] * q[3 * k + l];
        }
      }
      EXPECT_NEAR(after.covariance[3 * r + c], sum, 1e-7) << r << c;
    }
  }
}

TEST(SegmentMapFilter, TheFirstScanMakesTheMapAndLaterOnesHoldThePose) {
  SegmentMapFilter filter({}, at({}));
  const Observed first = filter.observe(room_seen({}));
  EXPECT_EQ(first.added, 3u);
  Pose truth;
  for (int i = 0; i < 30; ++i) {
    truth = compose(truth, {0.1, 0, 0.02});
    filter.predict(at({0.103, 0, 0.024}, 1e-7));  // odometry that errs by 3 % and 2 degrees a metre
    filter.observe(room_seen(truth));
  }
  const Pose end = filter.position().pose;
  EXPECT_LT(length(end.position() - truth.position()), 0.02);
  EXPECT_NEAR(end.heading, truth.heading, 0.01);
  EXPECT_EQ(filter.landmarks().size(), 3u);
}

TEST(SegmentMapFilter, ItLearnsHowTheOdometryErrs) {
  SegmentMapFilter filter({}, at({}));
  Pose truth;
  for (int i = 0; i < 400; ++i) {
    const bool straight = i % 40 < 20;
    const double way = straight ? (i % 80 < 40 ? 0.1 : -0.1) : 0.0, turn = straight ? 0.0 : 0.15;
    truth = compose(truth, {way, 0, turn});
    filter.predict(at({way / 1.01, 0, turn / 0.98 + 0.008 * way}, 1e-8));
    filter.observe(room_seen(truth));
  }
  EXPECT_NEAR(filter.calibration().travel, 0.01, 0.003);
  EXPECT_NEAR(filter.calibration().turn, -0.02, 0.003);
  EXPECT_NEAR(filter.calibration().drift_rad_per_m, -0.008, 0.002);
}

TEST(SegmentMapFilter, TheTwoFacesOfAWallAreTwoLandmarks) {
  SegmentMapFilter filter({}, at({}));
  const Point a{2, -2}, b{2, 2};
  posters::Segments segments;
  segments.items.push_back(seen({}, a, b));
  filter.observe(segments);
  const Pose behind{4, 0, 0};
  filter.predict(at(behind));
  segments.items.clear();
  segments.items.push_back(seen(behind, b, a));
  filter.observe(segments);
  EXPECT_EQ(filter.landmarks().size(), 2u);
}

TEST(SegmentMapFilter, SegmentsOnBothSidesOfADoorAreOneLandmarkWithAGap) {
  SegmentMapFilter filter({}, at({}));
  Pose robot;
  for (int i = 0; i < 6; ++i) {
    posters::Segments segments;
    segments.items.push_back(seen(robot, {2, -3}, {2, -0.5}));
    segments.items.push_back(seen(robot, {2, 0.5}, {2, 3}));
    segments.items.push_back(seen(robot, {-1, 4}, {-4, 4}));
    filter.observe(segments);
    filter.predict(at({0.12, 0, 0}, 1e-6));
    robot = compose(robot, {0.12, 0, 0});
  }
  EXPECT_EQ(filter.landmarks().size(), 2u);
  const auto map = std::make_unique<posters::SegmentMap>();
  filter.export_map(*map);
  ASSERT_EQ(map->items.size(), 3u);
  for (const auto& s : map->items) EXPECT_NEAR(length(s.end - s.start), s.start.y > 3.5 ? 3 : 2.5, 0.05);
}

TEST(SegmentMapFilter, AScanFromTheSamePlaceIsPassedOver) {
  SegmentMapFilter filter({}, at({}));
  filter.observe(room_seen({}));
  const double before = filter.position().covariance[0];
  for (std::uint32_t i = 1; i < Parameters{}.update_scans; ++i) EXPECT_EQ(filter.observe(room_seen({})).used, 0u);
  EXPECT_EQ(filter.position().covariance[0], before);
}

TEST(SegmentMapFilter, TwoLandmarksThatProveToBeOneAreMerged) {
  // Two stretches of a wall seen separately, with a very uncertain pose in between, then the whole wall.
  Parameters parameters;
  parameters.gap_m_max = 0.5;
  SegmentMapFilter filter(parameters, at({}));
  posters::Segments segments;
  segments.items.push_back(seen({}, {2, -4}, {2, -2}));
  filter.observe(segments);
  filter.predict(at({0, 3, 0}, 4e-4));
  const Pose robot{0, 3, 0};
  segments.items.clear();
  segments.items.push_back(seen(robot, {2.02, 1}, {2.02, 5}));
  filter.observe(segments);
  ASSERT_EQ(filter.landmarks().size(), 2u);
  segments.items.clear();
  segments.items.push_back(seen(robot, {2, -4}, {2, 5}));
  std::uint32_t merged = 0;
  for (int i = 0; i < 20; ++i) merged += filter.observe(segments).merged;
  EXPECT_EQ(merged, 1u);
  EXPECT_EQ(filter.landmarks().size(), 1u);
}

TEST(SegmentMapFilter, WithoutSegmentsItIsTheOdometry) {
  SegmentMapFilter filter({}, at({}));
  Pose odometry;
  double variance = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose step{0.05, 0, 0.01};
    odometry = compose(odometry, step);
    filter.predict(at(step, 1e-6));
    EXPECT_EQ(filter.observe({}).matched, 0u);
    EXPECT_GT(filter.position().covariance[8], variance);
    variance = filter.position().covariance[8];
  }
  EXPECT_NEAR(filter.position().pose.x, odometry.x, 1e-9);
  EXPECT_NEAR(filter.position().pose.heading, odometry.heading, 1e-9);
}

TEST(SegmentMapFilter, TheLastLandmarksAreKeptWithinTheBudget) {
  // An endless corridor, of which each stretch is another wall.
  Parameters parameters;
  parameters.landmarks_max = 12;
  SegmentMapFilter filter(parameters, at({}));
  const RandomStream draws(5, "r", "test.corridor");
  Pose robot;
  std::uint32_t forgotten = 0;
  for (int i = 0; i < 600; ++i) {
    posters::Segments segments;
    for (int k = 0; k < 6; ++k) {
      const int stretch = static_cast<int>(robot.x / 4) + k / 2;
      const double side = k % 2 ? 1.0 : -1.0;
      const double y = side * (1 + 0.4 * (stretch % 3)), x = 4.0 * stretch;
      const Point left{x + 3.8, y}, right{x, y};
      segments.items.push_back(side > 0 ? seen(robot, left, right) : seen(robot, right, left));
      if (k < 2) {
        segments.items.push_back(side > 0 ? seen(robot, {x + 8, 0.4 * side}, {x + 8, 1.5 * side})
                                          : seen(robot, {x + 8, 1.5 * side}, {x + 8, 0.4 * side}));
      }
    }
    forgotten += filter.observe(segments).forgotten;
    ASSERT_LE(filter.landmarks().size(), 12u);
    ASSERT_EQ(filter.covariance().size(), 6 + 2 * filter.landmarks().size());
    filter.predict(at({0.1, 0, 0}, 1e-6));
    robot.x += 0.1;
  }
  EXPECT_GT(forgotten, 20u);
  EXPECT_TRUE(is_positive(filter.covariance()));
  EXPECT_NEAR(filter.position().pose.x, robot.x, 0.1);
  EXPECT_NEAR(filter.position().pose.y, robot.y, 0.1);
}

TEST(SegmentMapFilter, ARobotThatSlipsFindsItsPlaceAgain) {
  SegmentMapFilter filter({}, at({}));
  Pose truth;
  for (int i = 0; i < 60; ++i) {
    truth = compose(truth, {0.05, 0, 0.1});
    if (i == 30) truth = compose(truth, {0.1, 0.1, 0.06});
    filter.predict(at({0.05, 0, 0.1}, 1e-7));
    filter.observe(room_seen(truth));
    if (i == 30) {
      EXPECT_GT(length(filter.position().pose.position() - truth.position()), 0.1);
    }
  }
  EXPECT_LT(length(filter.position().pose.position() - truth.position()), 0.05);
  EXPECT_LE(filter.landmarks().size(), 4u);
}

TEST(SegmentMapFilter, ImpossibleParametersAreBadInput) {
  Parameters parameters;
  EXPECT_NO_THROW(genom::Settings({{"landmarks_max", "1000", "s.yaml", 1}}).read(parameters));
  EXPECT_THROW(genom::Settings({{"landmarks_max", "0", "s.yaml", 1}}).read(parameters), BadInput);
  EXPECT_THROW(genom::Settings({{"angle_floor_rad", "0", "s.yaml", 1}}).read(parameters), BadInput);
}

TEST(SegmentMapFilter, TheCovarianceStaysPositiveOverManyUpdates) {
  SegmentMapFilter filter({}, at({}, 1e-4));
  Pose truth;
  for (int i = 0; i < 5000; ++i) {
    truth = compose(truth, {0.05, 0, 0.03});
    filter.predict(at({0.05, 0, 0.03}, 1e-7));
    filter.observe(room_seen(truth));
  }
  EXPECT_TRUE(is_positive(filter.covariance()));
  EXPECT_LT(length(filter.position().pose.position() - truth.position()), 0.02);
}

}  // namespace
}  // namespace waitpoint::segloc
