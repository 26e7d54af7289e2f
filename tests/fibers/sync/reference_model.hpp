// SPDX-License-Identifier: BSD-3-Clause
// The paper's Algorithms 1 and 2 written down a second time, as plainly as possible: no fibers, no heap, an event list
// that is a sorted vector, timers that are recurrent events for ever, and tasks that are interpreted. What a program
// does here, it must do on the scheduler.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <vector>

#include "tests/fibers/sync/random_program.hpp"

namespace waitpoint::reference {

/// A step done: by whom, when, and what came of it.
struct Done {
  std::size_t task = 0;
  std::size_t step = 0;
  std::int64_t time_ns = 0;  ///< local
  std::int64_t result = 1;   ///< of timed steps whether in time, of ticks how many
  friend auto operator<=>(const Done&, const Done&) = default;
};

struct Outcome {
  std::vector<Done> done;
  std::uint64_t events = 0;  ///< executed by tasks
  bool ended = false;        ///< all tasks; else the rest waits for ever
  std::int64_t end_ns = 0;
};

/// What the two algorithms leave open. The default is first in, first out.
struct Choices {
  /// The place among its ties of an event that `task` puts into the list after so many events of its own.
  std::function<std::uint64_t(std::size_t task, std::uint64_t sequence)> tie = nullptr;
  /// Which of `count` waiters `waker` serves after so many events of its own.
  std::function<std::uint32_t(std::size_t waker, std::uint64_t sequence, std::uint32_t count)> waiter = nullptr;
};

/// What the program does by the book.
Outcome run_by_the_book(const Program& program, const Choices& choices = {});

}  // namespace waitpoint::reference
