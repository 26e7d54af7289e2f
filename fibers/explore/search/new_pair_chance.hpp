// SPDX-License-Identifier: BSD-3-Clause
// How much a search has seen that has proved nothing. The method: pair_sample.hpp.
#pragma once

#include <cstdint>
#include <string>

namespace waitpoint::exploration {

/// The chance that one more schedule of a strategy shows a new reads-from pair.
struct NewPairChance {
  std::string strategy;         ///< draws one schedule independently of the other
  std::uint64_t schedules = 0;  ///< from which it is estimated
  std::uint64_t pairs = 0;      ///< the different ones that these have shown
  double estimate = 0;          ///< from 0 to 1
  double lower_bound = 0;       ///< of an interval of 95 % confidence
  double upper_bound = 1;       ///< the same
  bool is_at_accesses = false;  ///< accesses to memory were switch points
};

/// "57 pairs of events in 84 schedules of random, a new one in the next with a chance of 1.2 % (95 % confidence: 0.21 %
/// to 6.4 %)".
std::string to_text(const NewPairChance& chance);

}  // namespace waitpoint::exploration
