// SPDX-License-Identifier: BSD-3-Clause
//
// Attributes of threads: names, stacks, priorities and processors. Priorities and processors have no effect: every
// thread has a processor of its own.
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/thread.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

static_assert(sizeof(Thread::name) == 16 && sizeof(Thread::name) <= kernel::name_size, "the system's bound of names");
static_assert(sizeof(cpu_set_t) * 8 == CPU_SETSIZE);

char* end_of_page(char* address) { return address + (-reinterpret_cast<std::uintptr_t>(address) & 4095); }

// The processors of `set` that the process may use.
cpu_set_t usable_of(const cpu_set_t& set) {
  cpu_set_t usable{};
  WAITPOINT_NEXT(sched_getaffinity)(0, sizeof usable, &usable);
  CPU_AND(&usable, &usable, &set);
  return usable;
}

int take_processors(Thread& thread, const cpu_set_t& set) {
  const cpu_set_t usable = usable_of(set);
  if (CPU_COUNT(&usable) == 0) return EINVAL;
  thread.processors = usable;
  thread.has_processors = true;
  return 0;
}

int take_scheduling(Thread& thread, const pthread_attr_t& attributes) {
  int inherits = PTHREAD_INHERIT_SCHED;
  pthread_attr_getinheritsched(&attributes, &inherits);
  if (inherits == PTHREAD_INHERIT_SCHED) return 0;
  sched_param parameters{};
  pthread_attr_getschedpolicy(&attributes, &thread.policy);
  pthread_attr_getschedparam(&attributes, &parameters);
  thread.priority = parameters.sched_priority;
  const bool is_of_policy = thread.priority >= sched_get_priority_min(thread.policy) &&
                            thread.priority <= sched_get_priority_max(thread.policy);
  if (!is_of_policy) return EINVAL;
  return thread.priority > 0 && geteuid() != 0 ? EPERM : 0;
}

}  // namespace

int take_attributes(Thread& thread, const pthread_attr_t* attributes) {
  const Thread& maker = this_thread();
  thread.blocked = maker.blocked;
  thread.policy = maker.policy;
  thread.priority = maker.priority;
  thread.processors = maker.processors;
  thread.has_processors = maker.has_processors;
  if (attributes == nullptr) return 0;
  pthread_attr_getguardsize(attributes, &thread.guard_size);
  sigset_t blocked;
  if (pthread_attr_getsigmask_np(attributes, &blocked) == 0) thread.blocked = to_set(blocked) & ~unblockable;
  cpu_set_t processors;
  if (pthread_attr_getaffinity_np(attributes, sizeof processors, &processors) == 0 &&
      CPU_COUNT(&processors) < CPU_SETSIZE)
    if (const int error = take_processors(thread, processors); error != 0) return error;
  return take_scheduling(thread, *attributes);
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_setname_np(pthread_t id, const char* name) noexcept {
  before_call<"pthread_setname_np">(changing(place::threads));
  const std::size_t length = std::strlen(name);
  if (length > 15) return ERANGE;
  Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  std::memcpy(thread->task->name, name, length + 1);  // in reports
  std::memcpy(thread->name, name, length + 1);
  // The system shows the first thread's name as the process's.
  return thread->id == getpid() ? WAITPOINT_NEXT(prctl)(PR_SET_NAME, name, 0L, 0L, 0L) : 0;
}

WAITPOINT_INTERPOSED int pthread_getname_np(pthread_t id, char* name, std::size_t size) noexcept {
  before_call<"pthread_getname_np">(reading(place::threads));
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  if (size < 16) return ERANGE;
  if (!can_be_written(name, size)) return EFAULT;
  std::memcpy(name, thread->name, sizeof thread->name);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getattr_np(pthread_t id, pthread_attr_t* attributes) noexcept {
  before_call<"pthread_getattr_np">(reading(place::threads));
  Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  const kernel::Stack& stack = thread->task->fiber.stack;
  pthread_attr_init(attributes);
  pthread_attr_setdetachstate(attributes, thread->detached ? PTHREAD_CREATE_DETACHED : PTHREAD_CREATE_JOINABLE);
  pthread_attr_setguardsize(attributes, thread->guard_size);
  pthread_attr_setschedpolicy(attributes, thread->policy);
  const sched_param parameters{thread->priority};
  pthread_attr_setschedparam(attributes, &parameters);
  if (thread->stack != nullptr) return pthread_attr_setstack(attributes, thread->stack, thread->stack_size);
  // Programs map and protect whole pages, but the top of a task's stack is shifted within its page.
  const std::size_t size = thread->told_stack_size != 0 ? thread->told_stack_size : kernel::bytes(stack.size);
  WAITPOINT_CHECK(size <= kernel::bytes(stack.size), "a thread is told of a larger stack than its task has");
  thread->knows_stack = true;
  return pthread_attr_setstack(attributes, end_of_page(stack.high) - size, size);
}

WAITPOINT_INTERPOSED int pthread_setaffinity_np(pthread_t id, std::size_t size, const cpu_set_t* set) noexcept {
  before_call<"pthread_setaffinity_np">(changing(place::threads));
  Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  if (!can_be_read(set)) return EFAULT;
  if (size > sizeof *set) size = sizeof *set;
  if (CPU_COUNT_S(size, set) == 0) return EINVAL;
  cpu_set_t whole{};
  std::memcpy(&whole, set, size);
  return take_processors(*thread, whole);
}

WAITPOINT_INTERPOSED int pthread_getaffinity_np(pthread_t id, std::size_t size, cpu_set_t* set) noexcept {
  before_call<"pthread_getaffinity_np">(reading(place::threads));
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  if (!thread->has_processors) return sched_getaffinity(0, size, set) == 0 ? 0 : errno;
  if (size % sizeof(long) != 0) return EINVAL;
  std::memset(set, 0, size);
  std::memcpy(set, &thread->processors, size < sizeof *set ? size : sizeof *set);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_setschedparam(pthread_t id, int policy, const sched_param* parameters) noexcept {
  before_call<"pthread_setschedparam">(changing(place::threads));
  Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  const int least = sched_get_priority_min(policy), greatest = sched_get_priority_max(policy);
  if (least < 0 || parameters->sched_priority < least || parameters->sched_priority > greatest) return EINVAL;
  thread->policy = policy;
  thread->priority = parameters->sched_priority;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_setschedprio(pthread_t id, int priority) noexcept {
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  const sched_param parameters{priority};
  return pthread_setschedparam(id, thread->policy, &parameters);
}

WAITPOINT_INTERPOSED int pthread_getschedparam(pthread_t id, int* policy, sched_param* parameters) noexcept {
  before_call<"pthread_getschedparam">(reading(place::threads));
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  *policy = thread->policy;
  *parameters = {thread->priority};
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getcpuclockid(pthread_t id, clockid_t* clock) noexcept {
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  *clock = static_cast<clockid_t>(~static_cast<unsigned>(thread->id) << 3 | 6);  // as the system encodes it
  return 0;
}

// PR_SET_NAME and PR_GET_NAME are per thread, but the system knows only one.
WAITPOINT_INTERPOSED int prctl(int option, ...) noexcept {
  va_list more;
  va_start(more, option);
  unsigned long words[4];
  for (unsigned long& word : words) word = va_arg(more, unsigned long);
  va_end(more);
  if (is_simulated() && (option == PR_SET_NAME || option == PR_GET_NAME)) {
    Thread& thread = this_thread();
    char* const name = reinterpret_cast<char*>(words[0]);
    if (option == PR_GET_NAME ? !can_be_written(name) : !can_be_read(name)) return fail(EFAULT);
    if (option == PR_GET_NAME) {
      std::memcpy(name, thread.name, sizeof thread.name);
      return 0;
    }
    char cut[sizeof thread.name] = {};
    std::memcpy(cut, name, strnlen(name, sizeof cut - 1));
    return pthread_setname_np(reinterpret_cast<pthread_t>(thread.area), cut);
  }
  return WAITPOINT_NEXT(prctl)(option, words[0], words[1], words[2], words[3]);
}
