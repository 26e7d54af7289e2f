// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/calibration.hpp"

#include <algorithm>
#include <unordered_set>

#include "fibers/explore/search/pair_sample.hpp"
#include "tests/fibers/explore/completeness/interpreter.hpp"

namespace waitpoint::completeness {

Calibration calibrate(const Program& program, std::uint64_t sampled, std::uint64_t measured) {
  exploration::PairIncidence sample;
  std::unordered_set<std::uint64_t> seen;
  std::uint64_t with_new = 0;
  draw(program, sampled + measured, [&](std::span<const exploration::ReadsFrom> pairs) {
    if (sample.schedules() < sampled) {
      sample.take(pairs);
      for (const exploration::ReadsFrom& pair : pairs) seen.insert(pair.hash());
    } else {
      with_new += std::ranges::any_of(pairs, [&](const auto& pair) { return !seen.contains(pair.hash()); });
    }
  });
  return {*sample.chance(), static_cast<double>(with_new) / static_cast<double>(measured)};
}

}  // namespace waitpoint::completeness
