// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/thread.hpp"

#include <limits.h>
#include <setjmp.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/cancellation.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/keys.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/robust_mutexes.hpp"
#include "fibers/posix/thread_area.hpp"

extern "C" {
// Of the C library, for its own thread library.
void __ctype_init();
void __call_tls_dtors();
int __sigsetjmp(__jmp_buf_tag* buffer, int save_mask) noexcept;
void __pthread_register_cancel(__pthread_unwind_buf_t* buffer);
}

namespace waitpoint::posix {

Duration spent_by_all;

namespace {

Thread* main_thread = nullptr;
// Threads that have ended, whose areas nobody runs on or asks for any more, but the one that ended last.
Thread* to_free = nullptr;

void free_ended() {
  if (to_free == nullptr) return;
  free_thread_area(to_free->area);
  std::free(to_free);
  to_free = nullptr;
}

// Its task may still be underfoot until the next switch: freed when another is to be.
void let_go(Thread& thread) {
  if (&thread == main_thread) return;
  free_ended();
  to_free = &thread;
}

int make_id() {
  static int last = getpid();
  return ++last;
}

bool is_detached(const pthread_attr_t* attributes) {
  int state = PTHREAD_CREATE_JOINABLE;
  if (attributes != nullptr) pthread_attr_getdetachstate(attributes, &state);
  return state == PTHREAD_CREATE_DETACHED;
}

void count_threads() {
  ++record->threads_made;
  const std::uint32_t now = record->scheduler.tasks();
  if (now > record->threads_most) record->threads_most = now;
}

}  // namespace

Thread* find(pthread_t id) {
  void* const area = reinterpret_cast<void*>(id);
  return area == nullptr ? nullptr : thread_of_area(area);
}

Duration spent_by(int id) {
  for (const kernel::Task* task = record->scheduler.first_task(); task != nullptr; task = task->next)
    if (thread_of(*task).id == id) return thread_of(*task).spent;
  return {};
}

void adopt_main_thread(Thread& thread, kernel::Task& task) {
  main_thread = &thread;
  thread.task = &task;
  thread.area = own_thread_area();
  thread.id = getpid();
  std::strncpy(thread.name, program_invocation_short_name, sizeof thread.name - 1);
  thread_of_area(thread.area) = &thread;
  count_threads();
}

int create(pthread_t* id, const pthread_attr_t* attributes, StartRoutine start, bool is_c11, void* argument) {
  if (!is_simulated()) refuse("a thread is made before main() begins");
  pass(kernel::Operation::start, nullptr);
  auto* const memory = static_cast<Thread*>(std::malloc(sizeof(Thread)));
  if (memory == nullptr) return EAGAIN;
  Thread& thread = *new (memory) Thread();
  thread.id = make_id();
  thread.area = make_thread_area(thread.id);
  thread.start = start;
  thread.is_c11 = is_c11;
  thread.argument = argument;
  thread.detached = is_detached(attributes);
  std::memcpy(thread.name, this_thread().name, sizeof thread.name);
  char name[kernel::name_size];
  std::snprintf(name, sizeof name, "thread %u", record->threads_made);
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  kernel::Task* const task =
      thread.area == nullptr
          ? nullptr
          : scheduler.spawn(record->robot, {.name = name, .stack = kernel::StackSize::program}, run_thread, &thread);
  if (task == nullptr) {
    if (thread.area != nullptr) free_thread_area(thread.area);
    std::free(memory);
    return EAGAIN;
  }
  thread_of_area(thread.area) = &thread;
  task->fiber.thread_pointer = thread.area;
  thread.task = task;
  scheduler.enter(thread.end);
  thread.end.owner = task;
  __libc_single_threaded = 0;
  count_threads();
  *id = reinterpret_cast<pthread_t>(thread.area);
  return 0;
}

// On the thread's own stack and area. pthread_exit() and cancellation unwind to the buffer.
void run_thread(void* argument) {
  Thread& thread = *static_cast<Thread*>(argument);
  __ctype_init();
  __pthread_unwind_buf_t buffer;
  if (__sigsetjmp(reinterpret_cast<__jmp_buf_tag*>(buffer.__cancel_jmp_buf), 0) == 0) {
    __pthread_register_cancel(&buffer);
    if (thread.is_c11)
      thread.result = reinterpret_cast<void*>(static_cast<std::intptr_t>(thread.start.c11(thread.argument)));
    else
      thread.result = thread.start.posix(thread.argument);
  }
  end_thread(thread);
}

void end_thread(Thread& thread) {
  thread.exiting = true;
  __call_tls_dtors();
  destroy_values_of_keys();
  let_robust_mutexes_go();
  pass(kernel::Operation::release, &thread.end);
  thread.ended = true;
  thread.end.owner = nullptr;
  thread.task = nullptr;
  kernel::running->scheduler->wake_all(thread.end);
  if (thread.detached) let_go(thread);
}

int join(pthread_t id, void** result, Time deadline) {
  Thread* const thread = find(id);
  if (thread == nullptr) return ESRCH;
  if (thread == &this_thread()) return deadline == Time() ? EBUSY : EDEADLK;
  if (thread->detached || thread->has_joiner) return EINVAL;
  if (!thread->ended)
    for (const kernel::Task* waiter = this_thread().end.first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
      if (waiter == thread->task) return EDEADLK;
  const CancellationPoint point;
  pass(kernel::Operation::join, &thread->end);
  if (!thread->ended) {
    if (deadline <= kernel::running->local_time) return deadline == Time() ? EBUSY : ETIMEDOUT;
    thread->has_joiner = true;
    const bool came = point.block(thread->end, deadline);
    thread->has_joiner = false;
    if (!thread->ended) {
      if (point.was_cancelled()) leave_if_cancelled();
      if (!came) return ETIMEDOUT;
    }
  }
  if (result != nullptr) *result = thread->result;
  let_go(*thread);
  return 0;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*start)(void*),
                                        void* argument) noexcept {
  return create(id, attributes, {.posix = start}, false, argument);
}

WAITPOINT_INTERPOSED int pthread_join(pthread_t id, void** result) { return join(id, result, Time::max()); }

// Not while it runs: no time is no deadline.
WAITPOINT_INTERPOSED int pthread_tryjoin_np(pthread_t id, void** result) noexcept { return join(id, result, Time()); }

WAITPOINT_INTERPOSED int pthread_clockjoin_np(pthread_t id, void** result, clockid_t clock, const timespec* deadline) {
  if (deadline == nullptr) return join(id, result, Time::max());
  if (!is_valid(*deadline) || !is_clock_of_deadlines(clock)) return EINVAL;
  const Time time = when(clock, *deadline);
  return join(id, result, time > Time() ? time : Time::from_ns(1));
}

WAITPOINT_INTERPOSED int pthread_timedjoin_np(pthread_t id, void** result, const timespec* deadline) {
  return pthread_clockjoin_np(id, result, CLOCK_REALTIME, deadline);
}

WAITPOINT_INTERPOSED int pthread_detach(pthread_t id) noexcept {
  Thread* const thread = find(id);
  if (thread == nullptr) return ESRCH;
  if (thread->detached) return EINVAL;
  pass(kernel::Operation::release, &thread->end);
  thread->detached = true;
  if (thread->ended) let_go(*thread);
  return 0;
}

WAITPOINT_INTERPOSED void pthread_exit(void* result) {
  static constinit decltype(&pthread_exit) known = nullptr;
  if (is_simulated()) {
    this_thread().result = result;
    this_thread().exiting = true;
  }
  next(known, "pthread_exit")(result);
  __builtin_unreachable();
}
