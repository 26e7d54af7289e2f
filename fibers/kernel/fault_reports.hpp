// SPDX-License-Identifier: BSD-3-Clause
// Says which task it was when the process is about to die of a bad address.
//
// A task that runs over the end of its stack touches the guard page below it. That is reported as the bug it is: time,
// task, event, seed, replay line, the stack's size and how to ask for a larger one; then the process aborts. A stack
// without a guard page has a canary: found overwritten, it names its task in the same way. Any other bad address gets
// one line that says which task ran, and goes to whoever handled it before.
//
// The handler runs on a stack of its own (the task's is used up), and writes nothing that a signal handler may not.
#pragma once

#include <csignal>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {

class FaultReports {
 public:
  /// From here on, in the calling thread, for the tasks of `scheduler`. Where a sanitizer or valgrind is in the
  /// process, which have reports of their own, nothing is done.
  explicit FaultReports(const Scheduler& scheduler);
  /// What was there before is there again, unless a task has installed something since.
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

/// Reports that `task` ran over the end of its stack, and aborts.
[[noreturn]] void report_overflow(const Task& task);

}  // namespace waitpoint::kernel
