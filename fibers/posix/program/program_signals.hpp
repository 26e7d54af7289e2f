// SPDX-License-Identifier: BSD-3-Clause
// The signals of a program: its actions, and what is pending for it.
#pragma once

#include "fibers/posix/program/pending_signals.hpp"

namespace waitpoint::posix {

struct ProgramSignals {
  struct sigaction actions[signals_end];  ///< by number
  PendingSignals pending;                 ///< sent to the program
  SignalSet blocked_before_main = 0;
  SignalSet ever_blocked = 0;  ///< by any thread: caught even if not handled
  SignalSet interrupting = 0;  ///< of siginterrupt()

  /// True if its action is a function.
  bool is_handled(int signal) const {
    const struct sigaction& action = actions[signal];
    return (action.sa_flags & SA_SIGINFO) != 0 || (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
  }
  bool has_default(int signal) const { return actions[signal].sa_handler == SIG_DFL && !is_handled(signal); }
  bool is_discarded(int signal) const {
    const struct sigaction& action = actions[signal];
    if ((action.sa_flags & SA_SIGINFO) != 0) return false;
    return action.sa_handler == SIG_IGN || (action.sa_handler == SIG_DFL && contains(ignored_by_default, signal));
  }
};

}  // namespace waitpoint::posix
