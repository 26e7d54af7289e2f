// SPDX-License-Identifier: BSD-3-Clause
#include "modules/posters/uncertain_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"

namespace waitpoint::posters {
namespace {

constexpr Matrix3 covariance_a = {0.0004, 0.0001, 0.00005, 0.0001, 0.0009, -0.0001, 0.00005, -0.0001, 0.0004};
constexpr Matrix3 covariance_b = {0.0002, 0, 0, 0, 0.0001, 0.00002, 0, 0.00002, 0.0001};

// A draw of the pose, by the Cholesky factor of its covariance.
Pose draw(const UncertainPose& p, const RandomStream& random, std::uint64_t tick) {
  const Matrix3& c = p.covariance;
  const double l00 = std::sqrt(c[0]), l10 = c[3] / l00, l20 = c[6] / l00;
  const double l11 = std::sqrt(c[4] - l10 * l10), l21 = (c[7] - l20 * l10) / l11;
  const double l22 = std::sqrt(c[8] - l20 * l20 - l21 * l21);
  const double x = random.normal(tick, 0), y = random.normal(tick, 1), z = random.normal(tick, 2);
  return {p.pose.x + l00 * x, p.pose.y + l10 * x + l11 * y, p.pose.heading + l20 * x + l21 * y + l22 * z};
}

void expect_near(const Matrix3& a, const Matrix3& b, double tolerance) {
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "element " << i;
}

TEST(UncertainPose, ComposedCovarianceIsThatOfComposedDraws) {
  const UncertainPose a = {{1, 2, 0.7}, covariance_a}, b = {{2, -1, 0.4}, covariance_b};
  const UncertainPose c = compose(a, b);
  const RandomStream random_a(1, "test", "a"), random_b(1, "test", "b");
  constexpr int draws = 40000;
  Matrix3 sum{};
  for (std::uint64_t k = 0; k < draws; ++k) {
    const Pose d = waitpoint::compose(draw(a, random_a, k), draw(b, random_b, k));
    const double e[3] = {d.x - c.pose.x, d.y - c.pose.y, exact::wrap_angle(d.heading - c.pose.heading)};
    for (std::size_t i = 0; i < 9; ++i) sum[i] += e[i / 3] * e[i % 3] / draws;
  }
  for (const std::size_t i : {0u, 4u, 8u}) EXPECT_NEAR(sum[i] / c.covariance[i], 1, 0.03);
  expect_near(sum, c.covariance, 0.00005);
}

TEST(UncertainPose, IncrementUndoesComposition) {
  const UncertainPose a = {{1, 2, 2.7}, covariance_a}, b = {{0.3, -0.1, 0.9}, covariance_b};
  const UncertainPose found = increment(a, compose(a, b));
  EXPECT_NEAR(found.pose.x, b.pose.x, 1e-14);
  EXPECT_NEAR(found.pose.y, b.pose.y, 1e-14);
  EXPECT_NEAR(found.pose.heading, b.pose.heading, 1e-14);
  expect_near(found.covariance, b.covariance, 1e-16);
}

TEST(UncertainPose, FusionWeighsByCertaintyAndGainsCertainty) {
  const UncertainPose sure = {{1, 0, 0}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}};
  const UncertainPose unsure = {{2, 0, 0}, {0.03, 0, 0, 0, 0.03, 0, 0, 0, 0.03}};
  const UncertainPose fused = fuse(sure, unsure);
  EXPECT_NEAR(fused.pose.x, 1.25, 1e-12);
  EXPECT_NEAR(fused.covariance[0], 0.0075, 1e-12);
  const UncertainPose other_way = fuse(unsure, sure);
  EXPECT_NEAR(other_way.pose.x, fused.pose.x, 1e-12);
  expect_near(other_way.covariance, fused.covariance, 1e-15);
}

TEST(UncertainPose, FusionTakesTheShorterTurnBetweenHeadings) {
  const Matrix3 c = {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01};
  const UncertainPose fused = fuse({{0, 0, 3.1}, c}, {{0, 0, -3.1}, c});
  EXPECT_NEAR(std::fabs(fused.pose.heading), exact::pi, 1e-12);
}

TEST(UncertainPose, DisagreementIsChiSquareOfThreeDegrees) {
  const UncertainPose a = {{0, 0, 0}, covariance_a};
  const UncertainPose truth = {{0, 0, 0}, covariance_a + covariance_b};
  const RandomStream random(2, "test", "gate");
  int above = 0;
  double mean = 0;
  constexpr int draws = 20000;
  for (std::uint64_t k = 0; k < draws; ++k) {
    const double d = disagreement(a, {draw(truth, random, k), covariance_b});
    mean += d / draws;
    above += d > 7.815;  // 95 %
  }
  EXPECT_NEAR(mean, 3, 0.06);
  EXPECT_NEAR(static_cast<double>(above) / draws, 0.05, 0.006);
}

TEST(UncertainPose, GreatestDeviationIsTheEllipsesLongAxis) {
  const auto [s, c] = exact::sincos(0.6);
  const Matrix3 turn = {c, -s, 0, s, c, 0, 0, 0, 1};
  EXPECT_NEAR(greatest_deviation_m(congruent(turn, {0.09, 0, 0, 0, 0.01, 0, 0, 0, 1})), 0.3, 1e-12);
}

}  // namespace
}  // namespace waitpoint::posters
