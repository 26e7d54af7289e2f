// SPDX-License-Identifier: BSD-3-Clause
// Watches the wall clock for a task that never reaches its next event: a loop without a waitpoint, or a lock of the
// system's that nobody releases, which hold up all tasks of the run.
//
// After `limit_s` without an event it reports the running task, its virtual time and its call stack, and after six
// times that it ends the process with status 1. A run that SIGINT or SIGTERM interrupts ends within a second even if
// its task does not reach an event (status 130). The outputs up to there are kept (outputs.hpp). Nothing of this
// affects the run.
#pragma once

#include <ctime>

namespace waitpoint::tools {

/// True in a process that a debugger traces.
bool is_traced();

class RunWatchdog {
 public:
  /// Of commands that have no option for it.
  static constexpr double usual_limit_s = 10;

  /// `limit_s` 0: reports nothing, but still ends an interrupted run. Not in a process that a debugger traces.
  explicit RunWatchdog(double limit_s);
  ~RunWatchdog();
  RunWatchdog(const RunWatchdog&) = delete;
  RunWatchdog& operator=(const RunWatchdog&) = delete;

 private:
  timer_t timer_{};
  bool is_armed_ = false;
};

}  // namespace waitpoint::tools
