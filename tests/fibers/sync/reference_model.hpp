// SPDX-License-Identifier: BSD-3-Clause
// A second implementation of the paper's Algorithms 1 and 2, as plain as possible: no fibers, no heap, a sorted vector
// as the event list, timers as events that recur without end, and interpreted tasks. The scheduler must execute each
// program in the same way.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <vector>

#include "tests/fibers/sync/random_program.hpp"

namespace waitpoint::reference {

/// A completed step, with its result.
struct Done {
  std::size_t task = 0;
  std::size_t step = 0;
  std::int64_t time_ns = 0;  ///< local
  std::int64_t result = 1;   ///< of timed steps 1 if in time, of ticks their number
  friend auto operator<=>(const Done&, const Done&) = default;
};

struct Outcome {
  std::vector<Done> done;
  std::uint64_t events = 0;  ///< executed by tasks
  bool ended = false;        ///< all tasks ended; else some wait without end
  std::int64_t end_ns = 0;
};

/// The choices that the two algorithms leave open. The default is first in, first out.
struct Choices {
  /// The place among its ties of an event that `task` puts into the list after `sequence` events of its own.
  std::function<std::uint64_t(std::size_t task, std::uint64_t sequence)> tie = nullptr;
  /// The index of the waiter, of `count`, that `waker` serves after `sequence` events of its own.
  std::function<std::uint32_t(std::size_t waker, std::uint64_t sequence, std::uint32_t count)> waiter = nullptr;
};

/// The result of the program by the reference model.
Outcome run_by_the_book(const Program& program, const Choices& choices = {});

}  // namespace waitpoint::reference
