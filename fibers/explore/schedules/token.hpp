// SPDX-License-Identifier: BSD-3-Clause
// A failure in one word, to be copied: how to repeat the schedule that failed.
//
//   wx1.1.9f3a2c1b.pct:3.7.1234      schedule 1234 of strategy pct:3 with seed 7
//   wx1.1.9f3a2c1b.=12-1,40-2        the default order, but at its 12th choice alternative 1, at its 40th alternative 2
//   wx1.1.9f3a2c1b-4Fx0s.=12-1       the same, with a trail
//
// The second field counts the calls of explore() in the test, the third is the beginning of the digest of the run, by
// which another program's token is known; zeros where the run was cut off by a crash. Where there is room, a trail
// (trail.hpp) follows it, by which it is known too where the run of another program leaves this one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fibers/explore/schedules/trail.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::exploration {

struct Token {
  std::uint32_t call = 1;
  std::uint32_t digest = 0;  ///< see token_digest(); 0: not known
  std::string strategy;      ///< empty: the deviations
  std::uint64_t seed = 0;
  std::uint64_t number = 0;
  std::vector<Deviation> deviations;
  Trail trail = {};

  friend bool operator==(const Token&, const Token&) = default;
};

/// What a token keeps of a run's digest.
constexpr std::uint32_t token_digest(std::uint64_t digest) { return static_cast<std::uint32_t>(digest >> 32); }

/// Its eight digits.
std::string digest_text(std::uint32_t digest);

/// What a token can hold in a line; a schedule that needs more goes to a file.
inline constexpr std::size_t token_length_max = 80;

std::string to_text(const Token& token);
/// With this trail, where there is room for it in a line.
std::string to_text_with(Token token, const Trail& trail);
/// Throws BadInput, which says what was expected.
Token read_token(const std::string& text);
/// Whether `text` is meant as one, and not as the name of a file.
bool is_token(const std::string& text);

}  // namespace waitpoint::exploration
