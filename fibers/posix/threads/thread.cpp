// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/threads/thread.hpp"

#include <limits.h>
#include <linux/futex.h>
#include <setjmp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/tasks.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/stack_switch.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/input_output/asynchronous.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/program/processor_timers.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/thread_area.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/futex.hpp"
#include "fibers/posix/sync/futex_vectors.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/threads/keys.hpp"
#include "fibers/posix/threads/variables.hpp"
#include "fibers/posix/traps/library_calls.hpp"

extern "C" {
// Of the C library, for its own thread library.
void __ctype_init();
int __sigsetjmp(__jmp_buf_tag* buffer, int save_mask) noexcept;
void __pthread_register_cancel(__pthread_unwind_buf_t* buffer);
}

namespace waitpoint::posix {

void (*before_thread)() = nullptr;

namespace {

void execute(Thread& thread);

Thread* main_thread = nullptr;
// The last thread that has ended and is not needed any longer: its task may still run on its area and stack.
Thread* to_free = nullptr;

// pthread_exit() and cancellation jump to a __pthread_unwind_buf_t, which the layer's sigsetjmp() takes for a jump
// buffer.
static_assert(offsetof(__cancel_jmp_buf_tag, __mask_was_saved) == offsetof(__jmp_buf_tag, __mask_was_saved));
static_assert(sizeof(__pthread_unwind_buf_t) >= offsetof(__jmp_buf_tag, __saved_mask) + 2 * sizeof(unsigned long),
              "waitpoint_keep_mask() looks at two words of the mask");

void free_thread(Thread& thread) {
  unset_processor_timers_of(thread.spent);
  forget_destructors(thread);
  if (thread.owns_stack) munmap(thread.stack, thread.stack_size);
  std::free(thread.clock);
  free_thread_area(thread.area);
  std::free(&thread);
}

void free_ended() {
  if (to_free == nullptr) return;
  free_thread(*to_free);
  to_free = nullptr;
}

int last_id = 0;

int make_id() {
  if (!has_host) return family::next_id();
  if (last_id == 0) last_id = getpid();
  WAITPOINT_CHECK(last_id > 0, "there are no numbers left for threads");
  return ++last_id;
}

bool is_detached(const pthread_attr_t* attributes) {
  int state = PTHREAD_CREATE_JOINABLE;
  if (attributes != nullptr) pthread_attr_getdetachstate(attributes, &state);
  return state == PTHREAD_CREATE_DETACHED;
}

// Uses the stack of the attributes, or maps one of their size if a task's stack is too small. False without memory.
bool take_stack(Thread& thread, const pthread_attr_t* attributes) {
  void* low = nullptr;
  std::size_t size = 0;
  if (attributes == nullptr) {
    pthread_attr_t usual;
    if (pthread_getattr_default_np(&usual) != 0) return false;
    pthread_attr_getstacksize(&usual, &thread.told_stack_size);
    pthread_attr_destroy(&usual);
    if (thread.told_stack_size <= kernel::bytes(kernel::StackSize::program)) return true;
    size = thread.told_stack_size;
  }
  // glibc stores the high end: null if no stack was given.
  if (attributes != nullptr && pthread_attr_getstack(attributes, &low, &size) == 0 &&
      reinterpret_cast<std::uintptr_t>(low) + size != 0) {
    thread.stack = static_cast<char*>(low);
    thread.stack_size = size;
    return true;
  }
  thread.told_stack_size = size;
  if (size <= kernel::bytes(kernel::StackSize::program)) return true;
  low = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (low == MAP_FAILED) return false;
  thread.stack = static_cast<char*>(low);
  thread.stack_size = size;
  thread.owns_stack = true;
  return true;
}

void count_threads(Program& program) {
  ++program.threads_made;
  if (has_host) return;
  ++(family::is_first() ? record->threads_made : family::family->threads_made);
  const std::uint32_t now = kernel::roster(record->scheduler()).tasks();
  if (now > record->threads_most) record->threads_most = now;
}

// A record and an area for a thread; null without memory.
Thread* make_thread(Program& program) {
  auto* const memory = static_cast<Thread*>(std::malloc(sizeof(Thread)));
  if (memory == nullptr) return nullptr;
  Thread& thread = *new (memory) Thread();
  thread.program = &program;
  thread.id = make_id();
  thread.area = make_thread_area(thread.id);
  if (thread.area != nullptr) {
    thread_of_area(thread.area) = &thread;
    return &thread;
  }
  std::free(memory);
  return nullptr;
}

bool give_clock(Thread& thread) {
  void* const memory = std::malloc(sizeof(ProgramClock));
  if (memory != nullptr) thread.clock = new (memory) ProgramClock(record->settings.clock);
  return memory != nullptr;
}

// Makes the task, which begins now; false without memory.
bool begin(Thread& thread, kernel::Scheduler& scheduler, const char* name) {
  Program& program = *thread.program;
  WAITPOINT_CHECK(program.robot != nullptr, "a thread begins in a program without a robot");
  WAITPOINT_CHECK(thread.task == nullptr && thread_of_area(thread.area) == &thread,
                  "a thread begins twice, or on another's area");
  thread.body = execute;
  char whole_name[kernel::name_size];
  std::snprintf(whole_name, sizeof whole_name, "%s%s", program.label, name);
  if (record->settings.has_clock && !give_clock(thread)) return false;
  kernel::Task* const task = kernel::spawn(scheduler, *program.robot,
                                           {.name = whole_name,
                                            .stack = kernel::StackSize::program,
                                            .service = program.is_service,
                                            .clock = thread.clock != nullptr ? &thread.clock->local() : nullptr},
                                           run_thread, &thread);
  if (task == nullptr) return false;
  // The area of the process's own thread is the default of all fibers.
  if (thread.area != own_thread_area()) task->fiber.thread_pointer = thread.area;
  thread.task = task;
  count_threads(program);
  return true;
}

}  // namespace

// Its task may run until the next switch, so it is freed when the next thread has ended.
void let_go(Thread& thread) {
  if (&thread == main_thread) return;
  WAITPOINT_CHECK(thread.ended && thread.task == nullptr, "a thread is freed that has not ended");
  free_ended();
  thread.is_gone = true;
  to_free = &thread;
}

void begin_again_as_first(Thread& thread) {
  main_thread = &thread;
  thread.id = getpid();
  last_id = 0;
}

bool begin_main_thread(Thread& thread, Program& program, kernel::Scheduler& scheduler) {
  main_thread = &thread;
  thread.program = &program;
  thread.area = own_thread_area();
  thread.id = getpid();
  thread.blocked = program.signals.blocked_before_main;
  std::strncpy(thread.name, program_invocation_short_name, sizeof thread.name - 1);
  thread_of_area(thread.area) = &thread;
  return begin(thread, scheduler, "main");
}

Thread* make_main_thread(Program& program, kernel::Scheduler& scheduler, void* (*body)(void*), void* argument) {
  Thread* const thread = make_thread(program);
  if (thread == nullptr) return nullptr;
  thread->start.posix = body;
  thread->argument = argument;
  std::memcpy(thread->name, program.robot->name, sizeof thread->name - 1);
  if (begin(*thread, scheduler, "main")) return thread;
  free_thread(*thread);
  return nullptr;
}

void end_other_threads(const Program& program, kernel::Scheduler& scheduler) {
  for (kernel::Task *task = kernel::first_task(scheduler), *next = nullptr; task != nullptr; task = next) {
    next = task->next;
    if (task == kernel::running || !is_thread(*task) || thread_of(*task).program != &program) continue;
    WAITPOINT_CHECK(thread_of(*task).task == task, "a task runs a thread that has another task");
    forget_waiter(*task);
    forget_vector(*task);
    forget_worker(*task);
    system_v::forget_waiter(*task);
    kernel::end_in_place(*task);
    free_thread(thread_of(*task));
    kernel::free_stack(*task);
  }
}

int create(pthread_t* id, const pthread_attr_t* attributes, StartRoutine start, bool is_c11, void* argument) {
  if (!is_simulated()) refuse("a thread is made before main() begins");
  trap_open_mp();
  if (before_thread != nullptr) before_thread();
  Thread* const thread = make_thread(this_program());
  if (thread == nullptr) return EAGAIN;
  thread->start = start;
  thread->is_c11 = is_c11;
  thread->argument = argument;
  thread->detached = is_detached(attributes);
  std::memcpy(thread->name, this_thread().name, sizeof thread->name);
  thread->niceness = this_thread().niceness;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (const int error = take_attributes(*thread, attributes); error != 0) {
    free_thread(*thread);
    return error;
  }
  char name[kernel::name_size];
  std::snprintf(name, sizeof name, "thread %u", this_program().threads_made);
  if (!take_stack(*thread, attributes) || !begin(*thread, scheduler, name)) {
    free_thread(*thread);
    return EAGAIN;
  }
  kernel::enter(thread->end);
  thread->end.owner = thread->task;
  __libc_single_threaded = 0;
  *id = reinterpret_cast<pthread_t>(thread->area);
  pass(kernel::Operation::start, nullptr);  // here, so that the new thread can come first
  return 0;
}

namespace {

// On the thread's own stack and area. pthread_exit() and cancellation unwind to the buffer.
void call_start_routine(void* argument) {
  Thread& thread = *static_cast<Thread*>(argument);
  WAITPOINT_CHECK(own_thread_area() == thread.area, "a thread runs on another's area");
  leave_kernel(thread);
  __ctype_init();
  __pthread_unwind_buf_t buffer;
  if (__sigsetjmp(reinterpret_cast<__jmp_buf_tag*>(buffer.__cancel_jmp_buf), 0) == 0) {
    __pthread_register_cancel(&buffer);
    if (thread.is_c11)
      thread.result = reinterpret_cast<void*>(static_cast<std::intptr_t>(thread.start.c11(thread.argument)));
    else
      thread.result = thread.start.posix(thread.argument);
  }
}

}  // namespace

namespace {

void execute(Thread& thread) {
  if (thread.stack != nullptr)
    call_on(thread.stack, thread.stack_size, call_start_routine, &thread);
  else
    call_start_routine(&thread);
  end_thread(thread);
}

}  // namespace

void end_thread(Thread& thread) {
  thread.exiting = true;
  destroy_variables();
  destroy_values_of_keys();
  let_robust_mutexes_go();
  if (thread.program->thread_ends != nullptr) thread.program->thread_ends();
  end_running_thread();
}

namespace {

// The next thread on the task's stack needs all of it.
void unprotect_stack(const Thread& thread) {
  const kernel::Stack& stack = thread.task->fiber.stack;
  if (!thread.knows_stack || thread.stack != nullptr) return;
  mprotect(stack.low, static_cast<std::size_t>(stack.high - stack.low), PROT_READ | PROT_WRITE);
}

}  // namespace

// Between the last waitpoint and the task's end nothing else runs, so the next thread that ends can free its area.
void end_running_thread() {
  Thread& thread = this_thread();
  if (std::uint32_t* const word = thread.cleared_at_end; word != nullptr) {
    *word = 0;
    futex(word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
  }
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  pass(kernel::Operation::release, &thread.end);
  {
    const InKernel within;
    kernel::waitpoint(scheduler, kernel::Operation::end, nullptr);
  }
  WAITPOINT_CHECK(!thread.ended && thread.task == kernel::running, "a thread ends twice, or as another task");
  thread.ended = true;
  unset_processor_timers_of(thread.spent);
  unprotect_stack(thread);
  drop_signals(thread);
  leave_held_objects();
  thread.end.owner = nullptr;
  thread.task = nullptr;
  kernel::wake_all(scheduler, thread.end);
  if (thread.program->directory != directory_of_process) return_to_directory_of_process();
  if (thread.detached) let_go(thread);
  kernel::end_running_task();
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*start)(void*),
                                        void* argument) noexcept {
  if (is_host_code()) return of_c_library(&pthread_create, "pthread_create")(id, attributes, start, argument);
  return create(id, attributes, {.posix = start}, false, argument);
}

// The same for lookups.cpp, where the plain name would be the definition of a host, which asks for the next one.
extern "C" [[gnu::visibility("hidden"), gnu::alias("pthread_create"), gnu::nonnull(1, 3)]] int
waitpoint_own_pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*start)(void*),
                             void* argument) noexcept;

WAITPOINT_INTERPOSED void pthread_exit(void* result) {
  static constinit decltype(&pthread_exit) known = nullptr;
  if (is_simulated()) {
    this_thread().result = result;
    this_thread().exiting = true;
  }
  next(known, "pthread_exit")(result);
  __builtin_unreachable();
}
