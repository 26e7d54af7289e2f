// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/two_samples.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/exact_math.hpp"

namespace waitpoint::tools {
namespace {

/// The probability that Kolmogorov's statistic exceeds `x`: 2 sum of (-1)^(k-1) exp(-2 k^2 x^2).
double exceeds(double x) {
  constexpr double sure_below = 0.2;  // where the series converges slowly, to 1
  if (x < sure_below) return 1;
  double sum = 0;
  constexpr int terms = 100;
  for (int k = 1; k <= terms; ++k) {
    const double term = exact::exp(-2.0 * k * k * x * x);
    sum += k % 2 == 1 ? term : -term;
    if (term < 1e-12) break;
  }
  return std::clamp(2 * sum, 0.0, 1.0);
}

}  // namespace

TwoSamples compare_samples(std::vector<double> a, std::vector<double> b) {
  WAITPOINT_CHECK(!a.empty() && !b.empty(), "an empty sample is compared");
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  const auto of_a = static_cast<double>(a.size()), of_b = static_cast<double>(b.size());
  TwoSamples result;
  double greater = 0;  // pairs in which the second's value is greater, less those in which it is smaller
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const double value = std::min(a[i], b[j]);
    const std::size_t first_j = j, first_i = i;
    while (i < a.size() && a[i] <= value) ++i;
    while (j < b.size() && b[j] <= value) ++j;
    const auto equal = static_cast<double>(j - first_j);
    greater += equal * (static_cast<double>(first_i) - static_cast<double>(a.size() - i));
    const double apart = static_cast<double>(i) / of_a - static_cast<double>(j) / of_b;
    result.distance = std::max(result.distance, std::fabs(apart));
  }
  greater += static_cast<double>(b.size() - j) * of_a;  // those above all of the first
  result.delta = greater / (of_a * of_b);
  const double size = std::sqrt(of_a * of_b / (of_a + of_b));
  result.probability = exceeds((size + 0.12 + 0.11 / size) * result.distance);
  return result;
}

}  // namespace waitpoint::tools
