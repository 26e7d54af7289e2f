// SPDX-License-Identifier: BSD-3-Clause
// A thread of the program: a task of the simulation, with what the C library keeps of a thread.
#pragma once

#include <pthread.h>
#include <sched.h>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::posix {

/// What the uses of primitives and clocks of all threads have cost: the processor time of the process.
extern Duration spent_by_all;

/// How the function of a thread is called.
union StartRoutine {
  void* (*posix)(void*);
  int (*c11)(void*);
};

struct Thread {
  kernel::Task* task = nullptr;  ///< null once it has ended
  void* area = nullptr;          ///< the pthread_t
  StartRoutine start{};
  bool is_c11 = false;
  bool detached = false;
  bool has_joiner = false;
  bool ended = false;
  void* argument = nullptr;
  void* result = nullptr;
  int id = 0;  ///< what gettid() says
  kernel::Object end{"thread"};

  // What programs may write and read again; it changes nothing.
  char name[16] = {};
  int policy = SCHED_OTHER;
  int priority = 0;
  cpu_set_t processors{};
  bool has_processors = false;  ///< of its own: else those of the process

  /// What its uses of primitives and clocks have cost: its processor time.
  Duration spent;

  // Cancellation.
  bool cancelled = false;  ///< it is to leave at its next cancellation point
  bool cancel_disabled = false;
  bool cancel_at_once = false;
  bool in_cancellation_point = false;
  bool exiting = false;

  std::uint64_t signals = 0;  ///< sent by other threads, to be handled: bit n is signal n + 1

  /// Primitives used, and looks at clocks and turns given away, since virtual time was last moved for that: see
  /// waiting.hpp.
  std::uint32_t operations = 0;
  std::uint32_t looks = 0;
  /// Of a wait on a futex: which wake-ups are for it.
  std::uint32_t futex_mask = 0;
};

inline Thread& thread_of(const kernel::Task& task) { return *static_cast<Thread*>(task.argument); }
/// Of the running task.
inline Thread& this_thread() { return thread_of(*kernel::running); }

/// Whether the code is that of a simulated thread: before main() there is none.
inline bool is_simulated() { return kernel::running != nullptr; }

/// The thread with this id; null if it is none of ours.
Thread* find(pthread_t id);

/// The same, if it has not ended; else null.
inline Thread* find_running(pthread_t id) {
  Thread* const thread = find(id);
  return thread != nullptr && thread->task != nullptr ? thread : nullptr;
}

/// The processor time of the thread with this gettid(); none if it has ended.
Duration spent_by(int id);

/// Makes a thread; an error number.
int create(pthread_t* id, const pthread_attr_t* attributes, StartRoutine start, bool is_c11, void* argument);
/// As pthread_timedjoin_np, with a deadline of virtual time.
int join(pthread_t id, void** result, Time deadline);
/// What is done when a thread's function is done, but for the end of its task.
void end_thread(Thread& thread);
/// What a task of a thread executes: the function, as the C library would call it.
void run_thread(void* thread);
/// Makes the running task the thread that main() runs in.
void adopt_main_thread(Thread& thread, kernel::Task& task);

}  // namespace waitpoint::posix
