// SPDX-License-Identifier: BSD-3-Clause
// The interface of a strategy, which decides in the explored order in place of a fixed rule.
//
// At every event the strategy chooses one of the ready tasks of the present instant, which are listed in the order of
// their becoming ready; a task at its own waitpoint is among them. Each task's next operation is in its record:
// Task::operation on the object Task::at. A task whose timeout is due is listed too, still blocked: chosen, it times
// out; woken before, it continues as woken.
//
// Events of other phases, and times, are not choices: deliveries, timers and the world's step happen when they are due.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// The kinds of choices that virtual time leaves open.
enum class Choice : std::uint8_t {
  task,       ///< the next task
  waiter,     ///< the waiter that a primitive serves
  spurious,   ///< 1: a wait for a condition wakes spuriously
  loss,       ///< 1: a datagram is lost
  computing,  ///< the cost of a computation: one of the values offered
  process,    ///< the process, of several with one simulation, that executes the next event
  value,      ///< the store, counted from the newest, whose value a load returns
};

class Decisions {
 public:
  /// In place of a ready task's index: all ready tasks poll, so virtual time advances to the next event, and they
  /// continue there. Only if an event is due later.
  static constexpr std::uint32_t later = ~std::uint32_t{0};
  /// In place of an index: the next event is another run's, so this one's window ends.
  static constexpr std::uint32_t elsewhere = later - 1;

  /// The index in `ready` of the next task, `later` or `elsewhere`; `count` is at least 1.
  virtual std::uint32_t next(Task* const* ready, std::uint32_t count) = 0;
  /// The index of one of `count` alternatives, at least 2, at an operation of `task`.
  virtual std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) = 0;
  /// The cost of a computation of `task`, within [`least`, `greatest`].
  virtual Duration computing(const Task& task, Duration least, Duration greatest) = 0;

 protected:
  ~Decisions() = default;
};

}  // namespace waitpoint::kernel
