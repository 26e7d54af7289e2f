// SPDX-License-Identifier: BSD-3-Clause
//
// What can be asked and told of a thread beside its life: names, stacks, priorities and processors. Priorities and
// processors change nothing: every thread has a processor of its own.
#include <pthread.h>
#include <sched.h>

#include <cerrno>
#include <cstring>

#include "fibers/posix/interposed.hpp"
#include "fibers/posix/thread.hpp"

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_setname_np(pthread_t id, const char* name) noexcept {
  const std::size_t length = std::strlen(name);
  if (length > 15) return ERANGE;
  const Thread* const thread = find(id);
  if (thread == nullptr || thread->task == nullptr) return ESRCH;
  std::memcpy(thread->task->name, name, length + 1);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getname_np(pthread_t id, char* name, std::size_t size) noexcept {
  const Thread* const thread = find(id);
  if (thread == nullptr || thread->task == nullptr) return ESRCH;
  if (size < 16) return ERANGE;
  std::strncpy(name, thread->task->name, 15);
  name[15] = '\0';
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getattr_np(pthread_t id, pthread_attr_t* attributes) noexcept {
  const Thread* const thread = find(id);
  if (thread == nullptr || thread->task == nullptr) return ESRCH;
  const kernel::Stack& stack = thread->task->fiber.stack;
  pthread_attr_init(attributes);
  pthread_attr_setdetachstate(attributes, thread->detached ? PTHREAD_CREATE_DETACHED : PTHREAD_CREATE_JOINABLE);
  pthread_attr_setguardsize(attributes, 4096);
  return pthread_attr_setstack(attributes, stack.low, static_cast<std::size_t>(stack.high - stack.low));
}

WAITPOINT_INTERPOSED int pthread_setaffinity_np(pthread_t, std::size_t, const cpu_set_t*) noexcept { return 0; }
WAITPOINT_INTERPOSED int pthread_getaffinity_np(pthread_t, std::size_t size, cpu_set_t* set) noexcept {
  return sched_getaffinity(0, size, set) == 0 ? 0 : errno;
}
WAITPOINT_INTERPOSED int pthread_setschedparam(pthread_t, int, const sched_param*) noexcept { return 0; }
WAITPOINT_INTERPOSED int pthread_setschedprio(pthread_t, int) noexcept { return 0; }
WAITPOINT_INTERPOSED int pthread_getschedparam(pthread_t, int* policy, sched_param* parameters) noexcept {
  *policy = SCHED_OTHER;
  *parameters = {};
  return 0;
}
WAITPOINT_INTERPOSED int pthread_getcpuclockid(pthread_t, clockid_t* clock) noexcept {
  *clock = CLOCK_THREAD_CPUTIME_ID;
  return 0;
}
