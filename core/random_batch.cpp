// SPDX-License-Identifier: BSD-3-Clause
#include "core/random_batch.hpp"

#include <algorithm>
#include <cmath>

#include "core/exact_batch.hpp"
#include "core/exact_math.hpp"

namespace waitpoint {

void normal_pairs(const RandomStream& stream, std::uint64_t tick, std::uint64_t first,
                  std::span<std::array<double, 2>> pairs) {
  std::array<double, exact::batch> logarithm, angle, sine, cosine;
  while (!pairs.empty()) {
    const std::size_t count = std::min(pairs.size(), exact::batch);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [u, v] = stream.uniform_pair(tick, first + i);
      logarithm[i] = 1.0 - u;
      angle[i] = 2.0 * exact::pi * v;
    }
    exact::log(std::span(logarithm).first(count), logarithm);
    exact::sincos(std::span(angle).first(count), sine, cosine);
    for (std::size_t i = 0; i < count; ++i) {
      const double radius = std::sqrt(-2.0 * logarithm[i]);
      pairs[i] = {radius * cosine[i], radius * sine[i]};
    }
    pairs = pairs.subspan(count);
    first += count;
  }
}

}  // namespace waitpoint
