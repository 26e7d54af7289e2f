// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>

namespace waitpoint {
namespace {

using Block = std::array<std::uint32_t, 4>;

TEST(Philox, GivesThePublishedVectors) {  // Random123's kat_vectors, philox4x32 10
  EXPECT_EQ(philox_4x32_10({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox_4x32_10({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox_4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, IsAFunctionOfItsNameAndTheCounterAlone) {
  const RandomStream a(7, "r1", "sick.range"), same(7, "r1", "sick.range");
  const double late = a.uniform(1000, 5);
  for (std::uint64_t t = 0; t < 50; ++t) (void)same.normal(t);
  EXPECT_EQ(same.uniform(1000, 5), late);
}

TEST(RandomStream, DiffersBySeedRobotSourceTickAndIndex) {
  std::set<Block> blocks;
  for (std::uint64_t seed : {0, 1, 2})
    for (const char* robot : {"", "r1", "r2", "r1s"})
      for (const char* source : {"", "range", "srange"})
        for (std::uint64_t tick : {0ull, 1ull, 1ull << 32, 1ull << 63})
          for (std::uint64_t index : {0ull, 1ull, 1ull << 32, 1ull << 63})
            blocks.insert(RandomStream(seed, robot, source).block(tick, index));
  EXPECT_EQ(blocks.size(), 3u * 4 * 3 * 4 * 4);
}

TEST(RandomStream, UniformFillsTheUnitIntervalEvenly) {
  const RandomStream random(3, "r", "uniform");
  constexpr int n = 200'000, bins = 50;
  int counts[bins] = {};
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(static_cast<std::uint64_t>(i));
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++counts[static_cast<int>(u * bins)];
    sum += u;
  }
  double chi_square = 0;
  for (const int count : counts) chi_square += std::pow(count - n / bins, 2) / (n / bins);
  EXPECT_LT(chi_square, 90);  // 49 degrees of freedom: 1 in 4000
  EXPECT_GT(chi_square, 20);
  EXPECT_NEAR(sum / n, 0.5, 4 * std::sqrt(1.0 / 12 / n));
}

TEST(RandomStream, IntegersBelowABoundAreEvenAndInRange) {
  const RandomStream random(4, "r", "below");
  int counts[7] = {};
  for (std::uint64_t i = 0; i < 70'000; ++i) {
    const std::uint64_t value = random.below(7, 3, i);
    ASSERT_LT(value, 7u);
    ++counts[value];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 450);
  EXPECT_EQ(random.below(1, 9), 0u);
  EXPECT_GT(random.below(~0ull, 1), 1ull << 32);
  EXPECT_DEATH(random.below(0, 1), "bound of a random integer must be positive");
}

TEST(RandomStream, NormalHasTheMomentsAndTailsOfTheBellCurve) {
  const RandomStream random(5, "r", "normal");
  constexpr int n = 200'000;
  double sum[5] = {}, product = 0;
  int beyond[4] = {};
  for (int i = 0; i < n; ++i) {
    const auto [a, b] = random.normal_pair(static_cast<std::uint64_t>(i), 1);
    ASSERT_TRUE(std::isfinite(a) && std::isfinite(b));
    ASSERT_EQ(a, random.normal(static_cast<std::uint64_t>(i), 1));
    product += a * b;
    for (const double x : {a, b}) {
      double power = 1;
      for (double& s : sum) s += power, power *= x;
      for (int k = 1; k < 4; ++k) beyond[k] += std::fabs(x) > k;
    }
  }
  const double samples = 2.0 * n;
  EXPECT_NEAR(sum[1] / samples, 0, 4 / std::sqrt(samples));
  EXPECT_NEAR(sum[2] / samples, 1, 4 * std::sqrt(2 / samples));
  EXPECT_NEAR(sum[3] / samples, 0, 4 * std::sqrt(15 / samples));
  EXPECT_NEAR(sum[4] / samples, 3, 4 * std::sqrt(96 / samples));
  EXPECT_NEAR(product / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(beyond[1] / samples, 0.317311, 0.003);
  EXPECT_NEAR(beyond[2] / samples, 0.045500, 0.0014);
  EXPECT_NEAR(beyond[3] / samples, 0.002700, 0.0004);
}

TEST(RandomStream, NeighbouringCountersShareNoPattern) {
  const RandomStream random(6, "r", "neighbours");
  int equal_bits = 0;
  for (std::uint64_t i = 0; i < 1000; ++i)
    equal_bits += 32 - std::popcount(random.block(i)[0] ^ random.block(i + 1)[0]);
  EXPECT_NEAR(equal_bits, 16'000, 400);
}

}  // namespace
}  // namespace waitpoint
