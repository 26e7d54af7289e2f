// SPDX-License-Identifier: BSD-3-Clause
// Named random streams, without state.
//
// A stream is a function (tick, index) -> value, keyed by the run's seed, the robot and the source ("sick.range").
// Draws have no order and no state: one sensor's draws cannot shift another's numbers, and a replay may start anywhere.
//
// The function is Philox 4x32-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011):
// counter = (tick, index), key = hash(seed, robot, source). Distributions are our own: the standard library's differ
// between implementations.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace waitpoint {

class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view robot, std::string_view source);

  /// 128 random bits.
  std::array<std::uint32_t, 4> block(std::uint64_t tick, std::uint64_t index = 0) const;
  /// Two uniform reals in [0, 1), of one block.
  std::array<double, 2> uniform_pair(std::uint64_t tick, std::uint64_t index = 0) const;

  /// Uniform in [0, 1), 53 bits.
  double uniform(std::uint64_t tick, std::uint64_t index = 0) const;
  /// Uniform integer in [0, bound); `bound` must be positive. The bias is below bound / 2^64.
  std::uint64_t below(std::uint64_t bound, std::uint64_t tick, std::uint64_t index = 0) const;
  /// Standard normal (Box-Muller).
  double normal(std::uint64_t tick, std::uint64_t index = 0) const { return normal_pair(tick, index)[0]; }
  /// Two independent standard normals for the price of one: for arrays, use index / 2 and the element index % 2.
  std::array<double, 2> normal_pair(std::uint64_t tick, std::uint64_t index = 0) const;

 private:
  std::array<std::uint32_t, 2> key_;
};

/// The ten rounds of Philox 4x32, for the published test vectors.
std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

}  // namespace waitpoint
