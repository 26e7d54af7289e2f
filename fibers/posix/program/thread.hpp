// SPDX-License-Identifier: BSD-3-Clause
// A thread of the program: a task of the simulation, with the C library's attributes of a thread.
#pragma once

#include <pthread.h>
#include <sched.h>

#include "core/error.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/program/pending_signals.hpp"
#include "fibers/posix/program/program_clock.hpp"
#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix {

/// The start routine of a thread.
union StartRoutine {
  void* (*posix)(void*);
  int (*c11)(void*);
};

struct SharedFutex;
struct ThreadDestructor;

struct Thread {
  static constexpr std::uint32_t in_kernel = 1U << 31;
  bool is_in_kernel() const { return (operations & in_kernel) != 0; }
  void enter_kernel() {
    WAITPOINT_FAST_CHECK(!is_in_kernel(), "a thread enters the kernel from within");
    operations |= in_kernel;
  }
  void leave_kernel() {
    WAITPOINT_FAST_CHECK(is_in_kernel(), "a thread leaves the kernel from outside");
    operations &= ~in_kernel;
  }

  kernel::Task* task = nullptr;  ///< null once it has ended
  Program* program = nullptr;
  void* area = nullptr;             ///< the pthread_t
  void (*body)(Thread&) = nullptr;  ///< calls `start` as the C library would, and ends the thread
  StartRoutine start{};
  bool is_c11 = false;
  bool detached = false;
  bool has_joiner = false;
  bool ended = false;
  bool is_gone = false;  ///< ended, and joined or detached
  void* argument = nullptr;
  void* result = nullptr;
  /// A stack of the program's address or size; null: its task's stack is used.
  char* stack = nullptr;
  std::size_t stack_size = 0;
  bool owns_stack = false;  ///< the program gave only its size
  /// The size reported: less than that of its task's stack, if the program asked for less.
  std::size_t told_stack_size = 0, guard_size = 4096;
  bool knows_stack = false;  ///< the program was told the address, and may have protected some of its pages
  int id = 0;                ///< of gettid()
  kernel::Object end{"thread"};
  /// Set to zero, and its waiters woken, when the thread has ended: see set_tid_address(2).
  std::uint32_t* cleared_at_end = nullptr;

  // Attributes that programs may write and read; they have no effect.
  char name[16] = {};
  int policy = SCHED_OTHER;
  int priority = 0;
  int niceness = 0;  ///< added to the niceness of the process, which is its first thread's
  cpu_set_t processors{};
  bool has_processors = false;  ///< of its own; else the process's

  /// Its processor time: the cost of its uses of primitives and clocks.
  Duration spent;
  /// The cost of its own code; null: none.
  ProgramClock* clock = nullptr;

  // Cancellation.
  bool cancelled = false;  ///< it is to exit at its next cancellation point
  bool cancel_disabled = false;
  bool cancel_at_once = false;
  bool in_cancellation_point = false;
  bool exiting = false;

  // Signals: see signals.hpp.
  SignalSet blocked = 0;        ///< its mask
  SignalSet blocked_after = 0;  ///< with a temporary mask: the mask after a handler
  SignalSet awaited = 0;        ///< waited for by sigwait() and similar calls
  PendingSignals pending;
  stack_t alternate{nullptr, SS_DISABLE, 0};
  bool has_temporary_mask = false;
  bool in_wait = false;                   ///< that a signal interrupts
  bool woken_early = false;               ///< by a signal or a cancellation: what it waits for did not come
  bool woken_by_timer = false;            ///< the idle watch has not seen it continue yet
  bool delivery_due = false;              ///< notified of a signal after its wait had ended otherwise
  std::uintptr_t library_returns_to = 0;  ///< see library_return.hpp

  /// Uses of primitives since virtual time last advanced for them: see waiting.hpp. The bit `in_kernel` is set before
  /// the thread begins, and within calls of the kernel, which may show an event to a watch: calls made by that are not
  /// simulated.
  std::uint32_t operations = in_kernel;
  std::uint32_t batches = 0;         ///< the number of such counts that were not charged yet
  std::uint32_t comparisons = 0;     ///< of threads' ids, since it was last charged for them
  std::uint32_t looks = 0;           ///< the same as `operations` for readings of clocks and sched_yield()
  std::uint32_t clock_readings = 0;  ///< since other tasks had a turn
  std::uint32_t spins = 0;           ///< batches of accesses to memory without a call, at the instant `spins_at`
  Time spins_at;
  std::uint32_t futex_mask = 0;                 ///< of a wait on a futex: the wake-ups that end it
  SharedFutex* shared_futex = nullptr;          ///< on which it waits, if other processes may wake it
  ThreadDestructor* last_destructor = nullptr;  ///< see threads/variables.hpp
};

/// True if `thread` was cancelled, has cancellation enabled, and is not exiting already.
inline bool is_to_leave(const Thread& thread) { return thread.cancelled && !thread.cancel_disabled && !thread.exiting; }

/// Called, unless null, before the process makes a thread.
extern void (*before_thread)();

/// The entry of a thread's task: calls its body.
void run_thread(void* thread);

/// True if the task is a thread of a program.
inline bool is_thread(const kernel::Task& task) { return task.entry == run_thread; }
/// `task` must be a thread's.
inline Thread& thread_of(const kernel::Task& task) {
  WAITPOINT_FAST_CHECK(is_thread(task), "a task of another kind is taken for a thread");
  return *static_cast<Thread*>(task.argument);
}
/// The running thread.
inline Thread& this_thread() { return thread_of(*kernel::running); }
inline Program& this_program() { return *this_thread().program; }
/// The same; but before main(), and where no thread of a program runs, the one that is alone in its process.
inline Program& program_now() {
  return kernel::running != nullptr && is_thread(*kernel::running) ? this_program() : process_program;
}

/// True if the caller is code of a simulated thread; false before main().
inline bool is_simulated() {
  return kernel::running != nullptr && is_thread(*kernel::running) && !this_thread().is_in_kernel();
}

/// From the program's code to the kernel's, and back.
inline void enter_kernel(Thread& thread) {
  thread.enter_kernel();
  if (__builtin_expect(thread.program->directory != directory_of_process, 0)) return_to_directory_of_process();
}
inline void leave_kernel(Thread& thread) {
  if (__builtin_expect(thread.program->directory != directory_of_process, 0))
    enter_directory(thread.program->directory);
  thread.leave_kernel();
}

/// Marks the running thread as within the kernel.
class InKernel {
 public:
  InKernel() : thread_(this_thread()) { posix::enter_kernel(thread_); }
  ~InKernel() { posix::leave_kernel(thread_); }
  InKernel(const InKernel&) = delete;
  InKernel& operator=(const InKernel&) = delete;

 private:
  Thread& thread_;
};
/// The opposite: the kernel calls code of the program.
class OutOfKernel {
 public:
  OutOfKernel() : thread_(this_thread()) { posix::leave_kernel(thread_); }
  ~OutOfKernel() { posix::enter_kernel(thread_); }
  OutOfKernel(const OutOfKernel&) = delete;
  OutOfKernel& operator=(const OutOfKernel&) = delete;

 private:
  Thread& thread_;
};

/// The thread with this id; null if it is none of ours.
Thread* find(pthread_t id);

/// The same, but null for a thread that has ended.
inline Thread* find_running(pthread_t id) {
  Thread* const thread = find(id);
  return thread != nullptr && thread->task != nullptr ? thread : nullptr;
}

/// The processor time of the thread with this gettid(); zero if it has ended.
Duration spent_by(int id);

/// Makes a thread; returns an error number or 0. Defined in threads/, above all rooms whose waits the end of a thread
/// cleans up.
int create(pthread_t* id, const pthread_attr_t* attributes, StartRoutine start, bool is_c11, void* argument);

}  // namespace waitpoint::posix
