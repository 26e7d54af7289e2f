// SPDX-License-Identifier: BSD-3-Clause
// A thread of the program: a task of the simulation, with what the C library keeps of a thread.
#pragma once

#include <pthread.h>
#include <sched.h>

#include "fibers/kernel/scheduler.hpp"
#include "fibers/posix/program/pending_signals.hpp"
#include "fibers/posix/program/program_clock.hpp"
#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix {

/// How the function of a thread is called.
union StartRoutine {
  void* (*posix)(void*);
  int (*c11)(void*);
};

struct SharedFutex;

struct Thread {
  static constexpr std::uint32_t in_kernel = 1U << 31;
  bool is_in_kernel() const { return (operations & in_kernel) != 0; }
  void enter_kernel() { operations |= in_kernel; }
  void leave_kernel() { operations &= ~in_kernel; }

  kernel::Task* task = nullptr;  ///< null once it has ended
  Program* program = nullptr;
  void* area = nullptr;             ///< the pthread_t
  void (*body)(Thread&) = nullptr;  ///< calls `start` as the C library would, and ends the thread
  StartRoutine start{};
  bool is_c11 = false;
  bool detached = false;
  bool has_joiner = false;
  bool ended = false;
  void* argument = nullptr;
  void* result = nullptr;
  /// A stack that was asked for; null: that of its task will do.
  char* stack = nullptr;
  std::size_t stack_size = 0;
  bool owns_stack = false;  ///< the program gave only its size
  /// What is told of it: less than that of its task, if that was asked for.
  std::size_t told_stack_size = 0, guard_size = 4096;
  bool knows_stack = false;  ///< the program was told where it is, and may have protected some of its pages
  int id = 0;                ///< what gettid() says
  kernel::Object end{"thread"};
  /// What is zero, and whoever waits for it woken, when it has ended: as set_tid_address() says.
  std::uint32_t* cleared_at_end = nullptr;

  // What programs may write and read again; it changes nothing.
  char name[16] = {};
  int policy = SCHED_OTHER;
  int priority = 0;
  int niceness = 0;  ///< added to that of the process, which is its first thread's
  cpu_set_t processors{};
  bool has_processors = false;  ///< of its own: else those of the process

  /// What its uses of primitives and clocks have cost: its processor time.
  Duration spent;
  /// What its own code takes, where it has a clock.
  ProgramClock* clock = nullptr;

  // Cancellation.
  bool cancelled = false;  ///< it is to leave at its next cancellation point
  bool cancel_disabled = false;
  bool cancel_at_once = false;
  bool in_cancellation_point = false;
  bool exiting = false;

  // Signals: see signals.hpp.
  SignalSet blocked = 0;        ///< its mask
  SignalSet blocked_after = 0;  ///< with a temporary mask: the one that comes after a handler
  SignalSet awaited = 0;        ///< what it waits for by sigwait() and its kin
  PendingSignals pending;
  stack_t alternate{nullptr, SS_DISABLE, 0};
  bool has_temporary_mask = false;
  bool in_wait = false;  ///< that a signal ends
  bool woken_by_signal = false;
  bool delivery_due = false;              ///< told of a signal when its wait had ended otherwise
  std::uintptr_t library_returns_to = 0;  ///< see library_return.hpp

  /// Primitives used, and looks at clocks and turns given away, since virtual time was last moved for that: see
  /// waiting.hpp.
  ///
  /// With the bit of those that are in the kernel: it has not begun, or is within a call of the kernel's, which may
  /// show an event to whoever watches. What that calls is not simulated.
  std::uint32_t operations = in_kernel;
  std::uint32_t looks = 0;
  std::uint32_t clock_readings = 0;  ///< the same of clocks, since others had their turn
  /// Of a wait on a futex: which wake-ups are for it.
  std::uint32_t futex_mask = 0;
  SharedFutex* shared_futex = nullptr;  ///< and where it waits, if other processes may wake it
};

/// What a task of a thread executes: its body.
void run_thread(void* thread);

/// Of a task that is a thread's.
inline Thread& thread_of(const kernel::Task& task) { return *static_cast<Thread*>(task.argument); }
/// Of the running task.
inline Thread& this_thread() { return thread_of(*kernel::running); }
inline Program& this_program() { return *this_thread().program; }

/// Whether a task is a thread of a program.
inline bool is_thread(const kernel::Task& task) { return task.entry == run_thread; }
/// Whether the code is that of a simulated thread: before main() there is none.
inline bool is_simulated() {
  return kernel::running != nullptr && is_thread(*kernel::running) && !this_thread().is_in_kernel();
}

/// While it lives, the running thread is within the kernel.
class InKernel {
 public:
  InKernel() : thread_(this_thread()) { thread_.enter_kernel(); }
  ~InKernel() { thread_.leave_kernel(); }
  InKernel(const InKernel&) = delete;
  InKernel& operator=(const InKernel&) = delete;

 private:
  Thread& thread_;
};
/// The other way round: the kernel calls what is the program's.
class OutOfKernel {
 public:
  OutOfKernel() : thread_(this_thread()) { thread_.leave_kernel(); }
  ~OutOfKernel() { thread_.enter_kernel(); }
  OutOfKernel(const OutOfKernel&) = delete;
  OutOfKernel& operator=(const OutOfKernel&) = delete;

 private:
  Thread& thread_;
};

/// The thread with this id; null if it is none of ours.
Thread* find(pthread_t id);

/// The same, if it has not ended; else null.
inline Thread* find_running(pthread_t id) {
  Thread* const thread = find(id);
  return thread != nullptr && thread->task != nullptr ? thread : nullptr;
}

/// The processor time of the thread with this gettid(); none if it has ended.
Duration spent_by(int id);

/// Makes a thread; an error number. Defined in threads/, above all rooms whose waits a thread's end puts in order.
int create(pthread_t* id, const pthread_attr_t* attributes, StartRoutine start, bool is_c11, void* argument);

}  // namespace waitpoint::posix
