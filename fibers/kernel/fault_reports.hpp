// SPDX-License-Identifier: BSD-3-Clause
// Reports the task when the process is about to die of a bad address.
//
// A task that overruns its stack touches the guard page below it. The report has time, task, event, seed, replay line,
// the stack's size and the way to request a larger one; then the process aborts. A stack without a guard page has a
// canary: if it is overwritten, its task is reported in the same way. Any other bad address is reported in one line
// with the running task, and passed to the previous handler.
//
// The handler runs on a stack of its own, since the task's is used up, and is async-signal-safe.
#pragma once

#include <csignal>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {

class FaultReports {
 public:
  /// Installs the handler in the calling thread, for the tasks of `scheduler`; not with a sanitizer or valgrind, which
  /// have reports of their own.
  explicit FaultReports(const Scheduler& scheduler);
  /// Restores the previous handler, unless a task has installed another one since.
  ~FaultReports();
  FaultReports(const FaultReports&) = delete;
  FaultReports& operator=(const FaultReports&) = delete;

 private:
  static void handle(int signal, siginfo_t* info, void* context);
  static void pass_on(int signal, siginfo_t* info, void* context);

  const Scheduler& scheduler_;
  const FaultReports* outer_;
  struct sigaction previous_ {};
  stack_t previous_stack_{};
  bool has_stack_ = false;
};

/// Reports that `task` overran its stack, and aborts.
[[noreturn]] void report_overflow(const Task& task);

}  // namespace waitpoint::kernel
