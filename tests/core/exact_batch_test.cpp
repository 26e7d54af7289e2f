// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/exact_math.hpp"
#include "core/random.hpp"
#include "core/random_batch.hpp"

namespace waitpoint::exact {
namespace {

constexpr double special[] = {0.0,
                              -0.0,
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::denorm_min(),
                              std::numeric_limits<double>::max(),
                              -0x1p-950,
                              0x1p1010,
                              1.0,
                              1.4142135623730951};

// Equal bits, but any NaN for a NaN.
bool same(double a, double b) {
  return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Numbers of all magnitudes, of those usual in scans, near multiples of pi / 4, and special ones: not a multiple of
/// any width.
std::vector<double> numbers(const char* name, double greatest) {
  const RandomStream random(1, "", name);
  std::vector<double> all;
  for (std::uint64_t i = 0; i < 400003; ++i) {
    const double u = 2 * random.uniform(i) - 1;
    const std::uint64_t kind = i % 4;
    double x = u * 8;
    if (kind == 1) x = std::ldexp(u, static_cast<int>(random.below(2000, i, 1)) - 1000);
    if (kind == 2) x = u * 1e6;
    if (kind == 3) x = std::round(u * 1000) * (pi / 4);
    if (i % 997 == 0) x = special[i / 997 % std::size(special)];
    all.push_back(std::fabs(x) <= greatest || x != x ? x : u);
  }
  return all;
}

TEST(ExactBatch, SinesAndCosinesHaveTheBitsOfOne) {
  const std::vector<double> x = numbers("sincos", 1e6);
  std::vector<double> sines(x.size()), cosines(x.size());
  for (const BatchFunctions& functions : all_batch_functions()) {
    functions.sincos(x, sines.data(), cosines.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto [sine, cosine] = sincos(x[i]);
      ASSERT_TRUE(same(sines[i], sine) && same(cosines[i], cosine)) << functions.instruction_set << ' ' << x[i];
    }
  }
}

TEST(ExactBatch, AnglesHaveTheBitsOfOne) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const std::vector<double> x = numbers("x", any), y = numbers("y", any);
  std::vector<double> angles(x.size());
  for (const BatchFunctions& functions : all_batch_functions()) {
    functions.atan2(y, x.data(), angles.data());
    for (std::size_t i = 0; i < x.size(); ++i)
      ASSERT_TRUE(same(angles[i], atan2(y[i], x[i]))) << functions.instruction_set << ' ' << y[i] << ' ' << x[i];
  }
}

TEST(ExactBatch, LogarithmsHaveTheBitsOfOne) {
  const std::vector<double> x = numbers("log", std::numeric_limits<double>::infinity());
  std::vector<double> logarithms(x.size());
  for (const BatchFunctions& functions : all_batch_functions()) {
    functions.log(x, logarithms.data());
    for (std::size_t i = 0; i < x.size(); ++i)
      ASSERT_TRUE(same(logarithms[i], log(x[i]))) << functions.instruction_set << ' ' << x[i];
  }
}

TEST(ExactBatch, NormalPairsAreThoseOfTheStream) {
  const RandomStream random(7, "r", "noise");
  std::array<std::array<double, 2>, 181> pairs;
  normal_pairs(random, 5, 3, pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(pairs[i], random.normal_pair(5, 3 + i));
}

}  // namespace
}  // namespace waitpoint::exact
