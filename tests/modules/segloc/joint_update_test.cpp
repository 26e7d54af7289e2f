// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/joint_update.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "core/random.hpp"

namespace waitpoint::segloc {
namespace {

const RandomStream joint_draws(2, "r", "test.joint_update");

// A positive definite matrix: A A' + 1.
Covariance positive(std::size_t size) {
  Covariance p(size);
  p.append(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (std::size_t k = 0; k < 6; ++k) sum += joint_draws.normal(i, k) * joint_draws.normal(j, k);
      p(i, j) = sum;
    }
  }
  return p;
}

RowPair some_rows(std::size_t line, std::uint64_t tick) {
  RowPair rows;
  std::uint64_t n = 0;
  for (const std::size_t column : {std::size_t{0}, std::size_t{1}, std::size_t{2}, 3 + 2 * line, 4 + 2 * line}) {
    const auto [a, b] = joint_draws.normal_pair(1000 + tick, n++);
    rows.add_column(column, a, b);
  }
  const auto [v0, v1] = joint_draws.normal_pair(1000 + tick, n);
  rows.innovation = {v0, v1};
  rows.noise = {0.5, 0.1, 0.3};
  return rows;
}

// The textbook update, one pair of rows at a time: K = P H' S^-1, x += K v, P -= K H P. Returns v' S^-1 v.
double textbook(Covariance& p, std::vector<double>& x, RowPair rows) {
  const std::size_t n = p.size();
  std::vector<std::array<double, 2>> g(n);
  for (std::size_t i = 0; i < n; ++i) {
    g[i] = {};
    for (std::size_t a = 0; a < rows.columns; ++a) {
      g[i][0] += p(i, rows.column[a]) * rows.derivative[0][a];
      g[i][1] += p(i, rows.column[a]) * rows.derivative[1][a];
    }
  }
  double s00 = rows.noise[0], s01 = rows.noise[1], s11 = rows.noise[2];
  double v0 = rows.innovation[0], v1 = rows.innovation[1];
  for (std::size_t a = 0; a < rows.columns; ++a) {
    s00 += rows.derivative[0][a] * g[rows.column[a]][0];
    s01 += rows.derivative[0][a] * g[rows.column[a]][1];
    s11 += rows.derivative[1][a] * g[rows.column[a]][1];
    // The state has moved since the innovation was taken.
    v0 -= rows.derivative[0][a] * x[rows.column[a]];
    v1 -= rows.derivative[1][a] * x[rows.column[a]];
  }
  const double d = s00 * s11 - s01 * s01;
  for (std::size_t i = 0; i < n; ++i) {
    const double k0 = (g[i][0] * s11 - g[i][1] * s01) / d, k1 = (g[i][1] * s00 - g[i][0] * s01) / d;
    x[i] += k0 * v0 + k1 * v1;
    for (std::size_t j = 0; j <= i; ++j) p(i, j) -= k0 * g[j][0] + k1 * g[j][1];
  }
  return (v0 * v0 * s11 - 2 * v0 * v1 * s01 + v1 * v1 * s00) / d;
}

TEST(JointUpdate, IsTheTextbooksUpdateRowByRow) {
  const std::size_t lines = 6;
  Covariance p = positive(3 + 2 * lines), expected = p;
  std::vector<double> x(p.size(), 0.0);
  JointUpdate joint(8);
  joint.clear(p);
  std::uint64_t tick = 0;
  for (const std::size_t line : {0u, 3u, 5u, 3u}) {  // including two segments of one wall
    const RowPair rows = some_rows(line, tick++);
    const JointUpdate::Trial trial = joint.test(p, rows);
    joint.accept(p, rows);
    EXPECT_NEAR(trial.squared_distance, textbook(expected, x, rows), 1e-9);
  }
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(joint.correction(i), x[i], 1e-10);
  joint.apply(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) EXPECT_NEAR(p(i, j), expected(i, j), 1e-10);
  }
}

TEST(JointUpdate, RepeatedMeasurementsAddLittleInformation) {
  Covariance p = positive(5);
  JointUpdate joint(40);
  joint.clear(p);
  const RowPair rows = some_rows(0, 1);
  const double first = joint.test(p, rows).information;
  joint.accept(p, rows);
  const double second = joint.test(p, rows).information;
  EXPECT_GT(first, 1);
  EXPECT_LT(second, 2);  // at most the noise alone, once for each row
  for (int i = 0; i < 30; ++i) joint.accept(p, (joint.test(p, rows), rows));
  EXPECT_LT(joint.test(p, rows).information, 0.1);
}

TEST(JointUpdate, ATestThatIsNotAcceptedChangesNothing) {
  Covariance p = positive(7);
  JointUpdate joint(4);
  joint.clear(p);
  const RowPair a = some_rows(0, 1), b = some_rows(1, 2);
  joint.test(p, a);
  joint.accept(p, a);
  const double before = joint.test(p, a).squared_distance;
  joint.test(p, b);
  EXPECT_EQ(joint.test(p, a).squared_distance, before);
}

TEST(JointUpdate, CostOfFifteenLines) {
  for (const std::size_t lines : {100u, 200u}) {
    Covariance p = positive(3 + 2 * lines);
    JointUpdate joint(15);
    double least = 1e9;
    for (int repeat = 0; repeat < 10; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      joint.clear(p);
      for (std::size_t k = 0; k < 15; ++k) {
        const RowPair rows = some_rows(k * lines / 15, k);
        joint.test(p, rows);
        joint.accept(p, rows);
      }
      joint.apply(p);
      const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
      least = std::min(least, took.count());
    }
    std::printf("[ measured ] 15 lines at %zu landmarks: %.0f us\n", lines, least);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_GT(p(i, i), 0);
  }
}

}  // namespace
}  // namespace waitpoint::segloc
