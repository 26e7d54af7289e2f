// SPDX-License-Identifier: BSD-3-Clause
// Signals that were sent and not taken yet, of a thread or of the whole process.
//
// As in Linux: of a signal below SIGRTMIN one is kept at most, of the others all, in their order; what is taken first
// is the least number.
#pragma once

#include "fibers/posix/program/signal_set.hpp"

namespace waitpoint::posix {

struct PendingSignal {
  siginfo_t information{};
  PendingSignal* next = nullptr;
  /// Called when it is taken or dropped; null: it is freed then.
  void (*taken)(PendingSignal&) = nullptr;
};

class PendingSignals {
 public:
  SignalSet set() const { return set_; }
  /// Whether it was added, and not dropped.
  bool add(PendingSignal& signal);
  /// The next one among `set`; 0 if there is none.
  int take(SignalSet set, siginfo_t& information);
  void drop(SignalSet set);
  /// One that is no copy, where it is in here: taken out, and not told.
  void remove(const PendingSignal& signal);

 private:
  /// Takes out what is behind `before`; null: the first.
  PendingSignal& take_out_behind(PendingSignal* before);

  SignalSet set_ = 0;
  PendingSignal* first_ = nullptr;
  PendingSignal* last_ = nullptr;  ///< others may send thousands before one is taken
};

}  // namespace waitpoint::posix
