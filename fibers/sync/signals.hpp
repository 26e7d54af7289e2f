// SPDX-License-Identifier: BSD-3-Clause
// Signals: a task is sent a number, and its handler runs in it at its next waitpoint, as by POSIX (a robot is the
// process, a task the thread), with these choices where POSIX leaves some or where fibers differ:
//
//   * A handler runs at a waitpoint and nowhere else: never amidst computing, so it may use every primitive. It runs
//     before the operation whose waitpoint it is; while it runs, its own signal is blocked.
//   * Who blocks is not interrupted: the handler runs when the task was woken or its timeout came, before the blocking
//     call returns.
//   * A signal that is pending is pending once, however often it is sent. Of several pending the least number is first.
//   * A signal without a handler is a bug: there is no process to kill. One to be ignored has a handler that does
//   nothing.
//   * Signals still pending when a task ends are gone.
//
// An exception that escapes from a handler ends the run, like one that escapes from a task.
#pragma once

#include <cstdint>
#include <functional>

#include "fibers/sync/thread.hpp"

namespace waitpoint {

/// Signals are numbered from 1 to this.
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
  /// The least number in the set, which is not empty.
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
    WAITPOINT_CHECK(signal >= 1 && signal <= signals_max, "no signal has this number");
    return std::uint64_t{1} << (signal - 1);
  }
  std::uint64_t bits_ = 0;
};

using signal_handler = std::function<void(int signal)>;

/// What became of a signal: pthread_kill's 0 or ESRCH.
enum class signal_sent : std::uint8_t {
  pending,     ///< its task will meet it
  task_ended,  ///< there is no such task any more
};

/// Sends a signal to a thread; may be called by a timer's callback too.
signal_sent send_signal(const thread& to, int signal);
/// As above, to the task of this run that has this id: also to those that have no handle, as the first of all.
signal_sent send_signal(thread::id to, int signal);

/// Sets the handler of a signal for all tasks of the caller's robot that have none of their own; an empty one takes it
/// away.
void handle_robot_signal(int signal, signal_handler handler);

namespace this_thread {

/// Sets the caller's own handler of a signal; an empty one takes it away.
void handle_signal(int signal, signal_handler handler);
/// Sends a signal to the caller; unless it is blocked, its handler has run when this returns.
void raise_signal(int signal);
/// What is not to be delivered to the caller for now. Returns what was blocked before.
signal_set block_signals(signal_set blocked);
/// What is no longer to be blocked; what of it is pending has been delivered when this returns.
signal_set unblock_signals(signal_set unblocked);
signal_set blocked_signals();
/// What was sent to the caller and is not delivered yet.
signal_set pending_signals();

}  // namespace this_thread

namespace sync {

/// Runs the handlers of what is pending for `task`, which is running, and not blocked: the kernel calls it.
void deliver_signals(kernel::Task& task);

}  // namespace sync
}  // namespace waitpoint
