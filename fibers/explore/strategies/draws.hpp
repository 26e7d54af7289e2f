// SPDX-License-Identifier: BSD-3-Clause
// The random numbers of one schedule: a stream of its own per (seed, strategy, number of the schedule), so that any
// schedule of a campaign can be drawn without those before it.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/digest.hpp"
#include "core/random.hpp"

namespace waitpoint::exploration {

class Draws {
 public:
  Draws() = default;
  Draws(std::uint64_t seed, std::string_view strategy, std::uint64_t schedule) {
    const auto block = RandomStream(seed, "explore", strategy).block(schedule);
    state_ = std::uint64_t{block[0]} << 32 | block[1];
  }

  /// 64 random bits (splitmix64: Steele, Lea, Flood 2014).
  std::uint64_t bits() { return Digest::mix(state_ += 0x9E3779B97F4A7C15u); }
  /// Uniform in [0, bound); `bound` must be positive. The bias is below bound / 2^64.
  std::uint64_t below(std::uint64_t bound) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>(static_cast<Wide>(bits()) * bound >> 64);
  }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace waitpoint::exploration
