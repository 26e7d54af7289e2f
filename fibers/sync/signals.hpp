// SPDX-License-Identifier: BSD-3-Clause
// Signals: a number sent to a task, whose handler runs in the task at its next waitpoint. The semantics are those of
// POSIX (a robot is the process, a task the thread); where POSIX leaves a choice or fibers differ:
//
//   * A handler runs at a waitpoint and nowhere else: never amidst computing, so it may use every primitive. It runs
//     before the waitpoint's operation, with its own signal blocked.
//   * Blocking calls are not interrupted: the handler runs after the wake-up or timeout, before the call returns.
//   * Pending signals do not queue. Of several pending signals, the least number is delivered first.
//   * A signal without a handler is a misuse: there is no process to kill. To ignore a signal, give it an empty
//   function.
//   * Signals still pending at the end of a task are discarded.
//
// An exception that escapes from a handler ends the run, like one that escapes from a task.
#pragma once

#include <cstdint>
#include <functional>

#include "fibers/sync/thread.hpp"

namespace waitpoint {

/// Signals are numbered from 1 to signals_max.
inline constexpr int signals_max = 64;

/// A set of signals: sigset_t.
class signal_set {
 public:
  constexpr signal_set() = default;
  constexpr signal_set(std::initializer_list<int> signals) {
    for (const int signal : signals) add(signal);
  }
  static constexpr signal_set all() {
    signal_set set;
    set.bits_ = ~std::uint64_t{0};
    return set;
  }

  constexpr void add(int signal) { bits_ |= bit(signal); }
  constexpr void remove(int signal) { bits_ &= ~bit(signal); }
  constexpr bool contains(int signal) const { return (bits_ & bit(signal)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  /// The least number in the set, which must not be empty.
  constexpr int least() const { return __builtin_ctzll(bits_) + 1; }

  friend constexpr bool operator==(signal_set, signal_set) = default;
  friend constexpr signal_set operator|(signal_set a, signal_set b) { return of(a.bits_ | b.bits_); }
  friend constexpr signal_set operator-(signal_set a, signal_set b) { return of(a.bits_ & ~b.bits_); }

 private:
  static constexpr signal_set of(std::uint64_t bits) {
    signal_set set;
    set.bits_ = bits;
    return set;
  }
  static constexpr std::uint64_t bit(int signal) {
    WAITPOINT_REQUIRE(signal >= 1 && signal <= signals_max, "no signal has this number");
    return std::uint64_t{1} << (signal - 1);
  }
  std::uint64_t bits_ = 0;
};

using signal_handler = std::function<void(int signal)>;

/// The result of sending: pthread_kill's 0 or ESRCH.
enum class signal_sent : std::uint8_t {
  pending,     ///< to be delivered to the task
  task_ended,  ///< the task has ended
};

/// Sends a signal to a thread; may be called by a timer's callback too.
signal_sent send_signal(const thread& to, int signal);
/// As above, by the id of a task of this run: also for tasks without a handle, such as the first.
signal_sent send_signal(thread::id to, int signal);

/// Sets the robot-wide handler of a signal, for all tasks without one of their own; an empty one removes it.
void handle_robot_signal(int signal, signal_handler handler);

namespace this_thread {

/// Sets the caller's own handler of a signal; an empty one removes it.
void handle_signal(int signal, signal_handler handler);
/// Sends a signal to the caller; unless it is blocked, its handler has run on return.
void raise_signal(int signal);
/// Sets the caller's blocked signals. Returns the previous set.
signal_set block_signals(signal_set blocked);
/// Unblocks signals; those pending are delivered before it returns.
signal_set unblock_signals(signal_set unblocked);
signal_set blocked_signals();
/// The signals sent to the caller and not delivered yet.
signal_set pending_signals();

}  // namespace this_thread

namespace sync {

/// Runs the handlers of the pending, unblocked signals of `task`, the running one: called by the kernel.
void deliver_signals(kernel::Task& task);

}  // namespace sync
}  // namespace waitpoint
