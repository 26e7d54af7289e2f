// SPDX-License-Identifier: BSD-3-Clause
// What decides in place of a fixed order: exploration hangs on the chooser by this.
//
// At every event the tasks that can go on at the present instant stand side by side, in the order in which they came to
// be so, and one of them is chosen; a task at its own waitpoint is among them. What each is about to do stands in its
// record: Task::operation, and the object Task::at. One whose wait has just run out is blocked still, and is among them
// too: chosen, it times out; woken before, it goes on as woken.
//
// Events of other phases, and times, are no choice: deliveries, timers and the world come when they are due.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// What is chosen among alternatives that are equal to virtual time.
enum class Choice : std::uint8_t {
  task,       ///< which goes on
  waiter,     ///< whom a primitive serves
  spurious,   ///< whether a wait for a condition ends for nothing: 1
  loss,       ///< whether a datagram is lost: 1
  computing,  ///< what a computation costs: one of the values offered
};

class Decisions {
 public:
  /// In place of one of those that are ready: all of them poll for something that takes time. Only where something is
  /// due later; they go on at that instant.
  static constexpr std::uint32_t later = ~std::uint32_t{0};

  /// Which of `ready`, of which there are `count`, at least one, goes on; or `later`.
  virtual std::uint32_t next(Task* const* ready, std::uint32_t count) = 0;
  /// Which of `count` alternatives, at least two, at something that `task` does.
  virtual std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) = 0;
  /// What a computation of `task` costs, from `least` to `greatest`.
  virtual Duration computing(const Task& task, Duration least, Duration greatest) = 0;

 protected:
  ~Decisions() = default;
};

}  // namespace waitpoint::kernel
