// SPDX-License-Identifier: BSD-3-Clause
// The search tree of dynamic partial order reduction, along the present schedule: a state before each choice. Between
// schedules it can be passed to another process, which executes the next one, as numbers.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration::dpor {

/// The pending event of a task.
struct Event {
  std::uint64_t task = 0;
  Action action;
};

/// By task, the number of its events that happen before: a vector clock.
using Clock = std::map<std::uint64_t, std::uint32_t>;

struct State {
  std::vector<Event> ready;  ///< empty for a choice that is not between tasks
  std::vector<std::uint64_t> to_try;
  std::vector<std::uint64_t> tried;
  std::vector<Event> asleep;
  Event done;  ///< the event executed in this state
  std::uint32_t count = 0, chosen = 0;

  // Known once the present schedule has passed it.
  std::uint64_t sequence = 0;  ///< its task's events so far, as the kernel counts them
  std::uint32_t instant = 0;   ///< the number of its instant
  std::uint32_t number = 0;    ///< its number among its task's events
  Clock clock;                 ///< after it

  bool is_of_task() const { return !ready.empty(); }
  bool is_ready(std::uint64_t task) const;
  bool happens_before(const Clock& at) const;
};

using Path = std::vector<State>;

/// Without what is only known after a schedule.
std::vector<std::uint64_t> to_numbers(std::span<const State> path);
Path path_of(std::span<const std::uint64_t> numbers);

}  // namespace waitpoint::exploration::dpor
