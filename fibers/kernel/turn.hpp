// SPDX-License-Identifier: BSD-3-Clause
// The turn of the running task: where its events are hashed, and whether its fast path is open (fast_path.hpp). With
// `running` the only global: what a task does most often is done in its own frame, and is to need no more than this,
// its record and the object.
#pragma once

#include <cstdint>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

struct Turn {
  static constexpr std::uint64_t no_epoch = ~std::uint64_t{0};
  static constexpr Time never = Time::from_ns(-1);

  std::uint64_t fast_epoch = no_epoch;  ///< the fast path is open for the objects of this run; no_epoch: for none
  Time at = never;                      ///< the instant where it passes at once, be it seen or not
  PairDigest* lane = nullptr;           ///< of the task that ran last, too

  [[gnu::always_inline]] bool is_fast() const { return __builtin_expect(fast_epoch != no_epoch, 1); }
  void close() {
    at = never;
    fast_epoch = no_epoch;
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

}  // namespace waitpoint::kernel
