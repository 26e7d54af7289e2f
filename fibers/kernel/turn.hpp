// SPDX-License-Identifier: BSD-3-Clause
// The turn of the running task: where its events are hashed, and until when it passes its waitpoints without a look at
// the event list. With `running` the only global: what a task does most often is done in its own frame, and is to
// need no more than this, its record and the object.
#pragma once

#include <cstdint>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

struct Turn {
  static constexpr std::uint64_t no_epoch = ~std::uint64_t{0};
  static constexpr Time never = Time::from_ns(-1);

  std::uint64_t unseen_in = no_epoch;  ///< it passes unseen, at the objects of this run; no_epoch: outside any task too
  Time at = never;                     ///< the instant where it passes at once, be it seen or not
  PairDigest* lane = nullptr;          ///< of the task that ran last, too

  [[gnu::always_inline]] bool is_unseen() const { return __builtin_expect(unseen_in != no_epoch, 1); }
  void end_pass() {
    at = never;
    unseen_in = no_epoch;
  }
};
extern Turn turn;

/// An event of the running task is executed: hashed and counted.
[[gnu::always_inline]] inline void count_event(Task& task, Operation operation, const Object* object, Time now) {
  ++task.sequence;
  std::uint64_t what = static_cast<std::uint64_t>(operation) << 48;
  if (object != nullptr) what ^= object->identity;
  turn.lane->add(static_cast<std::uint64_t>(now.ns()), task.id + what);
}

/// A waitpoint of the running task where nothing can come between, and nobody watches; else false, with nothing done.
[[gnu::always_inline]] inline bool pass_unseen(Operation operation, Object& object) {
  if (__builtin_expect(object.epoch != turn.unseen_in, 0)) return false;
  Task& task = *running;
  if (__builtin_expect(task.turns >= turns_max, 0)) return false;
  ++task.turns;
  task.operation = operation;
  task.at = &object;
  count_event(task, operation, &object, turn.at);
  return true;
}

}  // namespace waitpoint::kernel
