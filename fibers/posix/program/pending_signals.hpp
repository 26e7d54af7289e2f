// SPDX-License-Identifier: BSD-3-Clause
// The pending signals of a thread or of the process.
//
// As in Linux: a signal below SIGRTMIN is queued once at most, the others as often as sent, in order; the least number
// is taken first.
#pragma once

#include "fibers/posix/program/signal_set.hpp"

namespace waitpoint::posix {

struct PendingSignal {
  siginfo_t information{};
  PendingSignal* next = nullptr;
  /// Called when it is taken or dropped; null: it is freed instead.
  void (*taken)(PendingSignal&) = nullptr;
};

class PendingSignals {
 public:
  SignalSet set() const { return set_; }
  /// False if it was dropped, as one already pending.
  bool add(PendingSignal& signal);
  /// Removes the next signal of `set` and returns its number; 0 without one.
  int take(SignalSet set, siginfo_t& information);
  void drop(SignalSet set);
  /// Removes `signal`, if it is pending here, without calling `taken`.
  void remove(const PendingSignal& signal);

 private:
  /// Removes the signal after `before`; null: the first.
  PendingSignal& take_out_behind(PendingSignal* before);

  SignalSet set_ = 0;
  PendingSignal* first_ = nullptr;
  PendingSignal* last_ = nullptr;  ///< other processes may send thousands before one is taken
};

}  // namespace waitpoint::posix
