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
  Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  std::memcpy(thread->task->name, name, length + 1);  // in reports
  std::memcpy(thread->name, name, length + 1);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getname_np(pthread_t id, char* name, std::size_t size) noexcept {
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  if (size < 16) return ERANGE;
  std::memcpy(name, thread->name, sizeof thread->name);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getattr_np(pthread_t id, pthread_attr_t* attributes) noexcept {
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  const kernel::Stack& stack = thread->task->fiber.stack;
  pthread_attr_init(attributes);
  pthread_attr_setdetachstate(attributes, thread->detached ? PTHREAD_CREATE_DETACHED : PTHREAD_CREATE_JOINABLE);
  pthread_attr_setguardsize(attributes, 4096);
  if (thread->stack != nullptr) return pthread_attr_setstack(attributes, thread->stack, thread->stack_size);
  return pthread_attr_setstack(attributes, stack.low, static_cast<std::size_t>(stack.high - stack.low));
}

WAITPOINT_INTERPOSED int pthread_setaffinity_np(pthread_t id, std::size_t size, const cpu_set_t* set) noexcept {
  Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  if (size > sizeof *set) size = sizeof *set;
  if (CPU_COUNT_S(size, set) == 0) return EINVAL;
  thread->processors = {};
  std::memcpy(&thread->processors, set, size);
  thread->has_processors = true;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getaffinity_np(pthread_t id, std::size_t size, cpu_set_t* set) noexcept {
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  if (!thread->has_processors) return sched_getaffinity(0, size, set) == 0 ? 0 : errno;
  std::memset(set, 0, size);
  std::memcpy(set, &thread->processors, size < sizeof *set ? size : sizeof *set);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_setschedparam(pthread_t id, int policy, const sched_param* parameters) noexcept {
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
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  *policy = thread->policy;
  *parameters = {thread->priority};
  return 0;
}

WAITPOINT_INTERPOSED int pthread_getcpuclockid(pthread_t id, clockid_t* clock) noexcept {
  const Thread* const thread = find_running(id);
  if (thread == nullptr) return ESRCH;
  *clock = static_cast<clockid_t>(~static_cast<unsigned>(thread->id) << 3 | 6);  // the kernel's number of it
  return 0;
}
