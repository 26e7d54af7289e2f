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
  void* area = nullptr;  ///< the pthread_t
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

/// What a thread that the running one makes begins with: what `attributes` (null: the default ones) ask for, and what
/// it inherits. An error number, or 0.
int take_attributes(Thread& thread, const pthread_attr_t* attributes);

/// What a task of a thread executes: the function, as the C library would call it.
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

/// The first task of the run, which leads to the others; not all are threads. Null outside any.
kernel::Task* first_task();

/// The thread with this id; null if it is none of ours.
Thread* find(pthread_t id);

/// The same, if it has not ended; else null.
inline Thread* find_running(pthread_t id) {
  Thread* const thread = find(id);
  return thread != nullptr && thread->task != nullptr ? thread : nullptr;
}

/// The thread with this gettid(); null without one.
Thread* thread_with_id(int id);

/// The processor time of the thread with this gettid(); none if it has ended.
Duration spent_by(int id);

/// Makes a thread; an error number.
int create(pthread_t* id, const pthread_attr_t* attributes, StartRoutine start, bool is_c11, void* argument);
/// As pthread_timedjoin_np, with a deadline of virtual time.
int join(pthread_t id, void** result, Time deadline);
/// What is done when a thread's function is done.
[[noreturn]] void end_thread(Thread& thread);
/// The running thread ends as it is: nothing of its own is called any more.
[[noreturn]] void end_running_thread();
/// The thread that main() runs in, where the process is one program: it has the area of the process's own thread. False
/// without memory.
bool begin_main_thread(Thread& thread, Program& program, kernel::Scheduler& scheduler);
/// The first thread of one of several programs; null without memory. It runs `body`.
Thread* make_main_thread(Program& program, kernel::Scheduler& scheduler, void* (*body)(void*), void* argument);
/// Ends all threads of `program` but the running one; nothing of theirs is unwound.
void end_other_threads(const Program& program, kernel::Scheduler& scheduler);

}  // namespace waitpoint::posix
