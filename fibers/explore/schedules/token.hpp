// SPDX-License-Identifier: BSD-3-Clause
// A replay token: one word, easy to copy, that repeats a failing schedule.
//
//   wx1.1.9f3a2c1b.pct:3.7.1234      schedule 1234 of strategy pct:3 with seed 7
//   wx1.1.9f3a2c1b.=12-1,40-2        the default order, but at its 12th choice alternative 1, at its 40th alternative 2
//   wx1.1.9f3a2c1b-4Fx0s.=12-1       the same, with a trail
//   wx1.1w.9f3a2c1b.=12-1,15-1       in weak memory
//
// The second field is the number of the call of explore() in the test, the third the leading digits of the run's
// digest, which detects tokens of another program; zeros if the run was cut off by a crash. If there is room, a trail
// (trail.hpp) follows, which locates the event where another program's run diverges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fibers/explore/schedules/trail.hpp"
#include "fibers/explore/strategies/memory_option.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::exploration {

struct Token {
  std::uint32_t call = 1;
  std::uint32_t digest = 0;  ///< see token_digest(); 0: unknown
  std::string strategy;      ///< empty: a token with deviations
  std::uint64_t seed = 0;
  std::uint64_t number = 0;
  std::vector<Deviation> deviations;
  Trail trail = {};
  Memory memory = Memory::sc;

  friend bool operator==(const Token&, const Token&) = default;
};

/// The part of a run's digest that a token stores.
constexpr std::uint32_t token_digest(std::uint64_t digest) { return static_cast<std::uint32_t>(digest >> 32); }

/// As eight hexadecimal digits.
std::string digest_text(std::uint32_t digest);

/// The greatest length of a token on a line; a longer schedule is stored in a file.
inline constexpr std::size_t token_length_max = 80;

std::string to_text(const Token& token);
/// Includes the trail, if it fits on the line.
std::string to_text_with(Token token, const Trail& trail);
/// Throws BadInput with the expected format.
Token read_token(const std::string& text);
/// True if `text` is a token rather than a file's name.
bool is_token(const std::string& text);

}  // namespace waitpoint::exploration
