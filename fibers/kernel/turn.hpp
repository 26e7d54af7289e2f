// SPDX-License-Identifier: BSD-3-Clause
// The turn of the running task: the digest that its events are hashed into, and the state of its fast path
// (fast_path.hpp). The thread's own, as is `running`: the most frequent calls, inline in the task's frame, need only
// these two, the task's record and the object (waitpoint_calls.hpp).
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

  std::uint64_t fast_epoch = no_epoch;  ///< the epoch of the objects for which the fast path is open; no_epoch: none
  Time at = never;                      ///< the instant whose waitpoints pass without a search, watched or not
  PairDigest* digest = nullptr;         ///< the digest of the task that runs or ran last
  bool transferred = false;             ///< see note_transfer(); reset at each check of progress
  std::uint64_t blocks = 0;             ///< number of basic blocks of instrumented code executed (block_calls.cpp)
  std::uint64_t epoch = no_epoch;       ///< the epoch of the run that is executed, or was executed last

  [[gnu::always_inline]] bool is_fast() const { return __builtin_expect(fast_epoch != no_epoch, 1); }
  /// True if `task`, the running one, passes its next waitpoint without a search of the event list.
  bool holds_for(const Task& task) const { return task.local_time == at && task.waitpoints < waitpoints_max; }
  /// To be called when the local time of the running task leaves the present instant, and when anything else could
  /// come before its next waitpoint.
  void close() {
    at = never;
    fast_epoch = no_epoch;
  }
};
[[gnu::tls_model("initial-exec")]] extern constinit thread_local Turn turn;

/// To be called by a primitive when a unit, a letter, data or a notification that one task gave has reached another
/// one: the run makes progress, though virtual time may stand still. Not for a lock that is handed over, a failed
/// attempt, a timeout.
inline void note_transfer() { turn.transferred = true; }

/// Hashes and counts an event of the running task.
[[gnu::always_inline]] inline void count_event(Task& task, Operation operation, const Object* object, Time now) {
  ++task.sequence;
  std::uint64_t what = static_cast<std::uint64_t>(operation) << 48;
  if (object != nullptr) what ^= object->identity;
  turn.digest->add(static_cast<std::uint64_t>(now.ns()), task.id + what);
}

}  // namespace waitpoint::kernel
