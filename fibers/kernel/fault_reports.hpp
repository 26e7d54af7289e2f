// SPDX-License-Identifier: BSD-3-Clause
// Reports the task when the process is about to die in it: of SIGSEGV, SIGBUS, SIGILL, SIGFPE or SIGABRT (a failed
// assert, std::terminate, a corrupted heap), or by exit().
//
//   waitpoint: the process dies of SIGFPE (integer division by zero)
//     at virtual time 0.250000000 s, in task main of blinker, at its event 12 (sleep), seed 3
//     in codel exec of Blink
//     replay: ...
//
// Then the signal takes its usual course: the previous handler, or the default action. A task that overruns its stack
// touches the guard page below it: its report has the stack's size and the way to request a larger one. A stack without
// a guard page has a canary: if it is overwritten, its task is reported in the same way.
//
// The handlers are the process's: the first thread that needs them installs them, the last restores the previous ones.
// Each thread reports its own tasks.
//
// The handler runs on a stack of its own, since the task's may be used up, and is async-signal-safe. What is not, such
// as unwinding a call stack and completing files, is done by a forked copy of the process: whatever state the heap is
// in, and however that ends, the process itself only waits for it.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstddef>
#include <iterator>
#include <optional>

#include "fibers/kernel/handler_stack.hpp"
#include "fibers/kernel/process_end.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Task;

class FaultReports {
 public:
  /// Installs the handlers in the calling thread, for the tasks of `scheduler`; null: outside of runs. Not with a
  /// sanitizer or valgrind, which have reports of their own. An inner one only changes the scheduler.
  explicit FaultReports(Scheduler* scheduler);
  /// Restores the previous handlers, except where a task has installed another one since.
  ~FaultReports();
  FaultReports(const FaultReports&) = delete;
  FaultReports& operator=(const FaultReports&) = delete;

  static constexpr int signals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP, SIGSYS};

  /// The process that made it: not the one that a task forked.
  pid_t process() const { return process_; }

 private:
  static void handle(int signal, siginfo_t* info, void* context);
  static void pass_on(int signal, siginfo_t* info, void* context);

  FaultReports& outermost();

  FaultReports* outer_;  // of this thread
  Scheduler* scheduler_;
  pid_t process_;
  std::optional<TaskThread> thread_;   // of the outermost one
  std::optional<HandlerStack> stack_;  // likewise
};

/// Called in a forked copy of the process, with the reason: "the process dies of SIGFPE (integer division by zero)".
/// Two copies, one after the other: a call stack that cannot be read does not cost the outputs.
using PostMortem = void (*)(const char* reason);
/// Sets the function that writes the interrupted call stack to the error stream; null: none.
void set_call_stack_writer(PostMortem function);
/// Sets the function that completes the outputs, and returns the previous one; null: none.
PostMortem set_post_mortem(PostMortem function);

/// From now on every end of the process is a death of this run, until a null pointer is set (unfinished_run.hpp).
/// Reports outside of tasks show the replay line; those of tasks have their scheduler's.
void set_unfinished_run(const char* replay_line);

/// Writes `reason`, the running task and its call stack to the error stream. Async-signal-safe.
void report(const char* reason);
/// The same, then the post mortem: the process must end after it.
void report_death(const char* reason);

/// True in the process that made the FaultReports, until its death is reported: not in one that a task forked.
bool in_reporting_process();
/// True in any thread of that process while a run is unfinished.
bool in_unfinished_run();
/// True in a task and in a module's constructor or destructor: not in other threads, nor in a process that a task
/// forked, nor when the process is dying.
bool in_model_code();
/// In model code, and anywhere in an unfinished run: reports the call of `function` ("exit()"), and ends the process
/// with status 1.
void refuse_exit(const char* function);

/// Reports that `task` overran its stack, and aborts.
[[noreturn]] void report_overflow(const Task& task);

}  // namespace waitpoint::kernel
