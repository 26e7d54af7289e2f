// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/covariance.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace waitpoint::segloc {
namespace {

const RandomStream draws(1, "r", "test.covariance");

Covariance filled(std::size_t size, std::size_t capacity) {
  Covariance p(capacity);
  p.append(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) p(i, j) = draws.uniform(i, j);
  }
  return p;
}

TEST(Covariance, IsSymmetric) {
  Covariance p = filled(5, 9);
  p(1, 4) = 7;
  EXPECT_EQ(p(4, 1), 7);
}

TEST(Covariance, SubtractsProductsToTheBitAsTheDefinitionSays) {
  for (const std::size_t size : {1u, 3u, 4u, 7u, 21u}) {
    Covariance p = filled(size, 23);
    const Covariance before = p;
    const std::size_t count = 5;
    std::vector<double> rows(count * p.stride());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = draws.uniform(100 + i) - 0.5;
    p.subtract_products(rows.data(), count);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = 0;
        for (std::size_t r = 0; r < count; ++r) sum += rows[r * p.stride() + i] * rows[r * p.stride() + j];
        EXPECT_EQ(p(i, j), before(i, j) - sum) << size << ' ' << i << ' ' << j;
      }
    }
  }
}

TEST(Covariance, RemovingMovesTheLastVariablesIntoTheGap) {
  const Covariance before = filled(9, 9);
  Covariance p = before;
  p.remove(3, 2);
  ASSERT_EQ(p.size(), 7u);
  const std::size_t from[] = {0, 1, 2, 7, 8, 5, 6};
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < 7; ++j) EXPECT_EQ(p(i, j), before(from[i], from[j])) << i << ' ' << j;
  }
  p.remove(5, 2);
  ASSERT_EQ(p.size(), 5u);
  EXPECT_EQ(p(4, 3), before(8, 7));
}

TEST(Covariance, AppendedVariablesAreUncorrelated) {
  Covariance p = filled(6, 6);
  p.remove(4, 2);
  p.append(2);
  for (std::size_t i = 4; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) EXPECT_EQ(p(i, j), 0);
  }
}

TEST(Covariance, GrowsWithoutAChangeOfItsElements) {
  const Covariance whole = filled(40, 40);
  Covariance p(40);
  for (std::size_t size = 0; size < 40; size += 2) {
    p.append(2);
    for (std::size_t i = size; i < size + 2; ++i)
      for (std::size_t j = 0; j <= i; ++j) p(i, j) = whole(i, j);
  }
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t j = 0; j < 40; ++j) EXPECT_EQ(p(i, j), whole(i, j)) << i << ' ' << j;
}

TEST(Covariance, AColumnIsWhatTheElementsAre) {
  const Covariance p = filled(7, 8);
  std::vector<double> column(7);
  p.column(3, column.data());
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(column[i], p(i, 3));
}

}  // namespace
}  // namespace waitpoint::segloc
