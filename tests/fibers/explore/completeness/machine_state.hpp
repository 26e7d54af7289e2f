// SPDX-License-Identifier: BSD-3-Clause
// A state of the abstract machine, and the steps that belong to the event before: creations, skips, the start of a
// sleep.
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

/// Thread `t` exists from now on.
void begin(const Program& program, State& state, std::size_t t, int creator);
/// Takes the steps of thread `t` up to its next event.
void settle(const Program& program, State& state, std::size_t t);
/// Thread `t` has what it waited for; with a timeout, it reads its success.
void resume(const Program& program, State& state, std::size_t t);
/// The waiter for a condition must have its mutex again.
void notify(Thread& waiter);
/// The threads, in ascending order, that wait for each other without a timeout, `t` among them; empty if there are
/// none.
std::vector<std::size_t> cycle_through(const State& state, std::size_t t);

}  // namespace waitpoint::completeness
