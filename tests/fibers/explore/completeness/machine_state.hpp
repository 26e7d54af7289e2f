// SPDX-License-Identifier: BSD-3-Clause
// A state of the abstract machine.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "tests/fibers/explore/completeness/program.hpp"

namespace waitpoint::completeness {

inline constexpr int nobody = -1;

enum class Mode : std::uint8_t { absent, ready, relocking, locking, waiting, acquiring, joining, asleep, ended };

struct Thread {
  Mode mode = Mode::absent;
  std::uint8_t object = 0;   // that it waits for, or relocks
  std::uint8_t place = 0;    // of its next instruction
  int wakes = 0;             // the instant at which it wakes, or its wait times out; 0: none
  bool is_notified = false;  // its wait for a condition has not timed out
  int creator = nobody;      // that may join it
  std::vector<int> reads;
  auto operator<=>(const Thread&) const = default;
};

struct State {
  int now = 0;
  std::array<int, objects> owners{nobody, nobody};
  std::array<int, objects> units{}, values{};
  std::array<Thread, threads_max> threads;
  auto operator<=>(const State&) const = default;
};

}  // namespace waitpoint::completeness
