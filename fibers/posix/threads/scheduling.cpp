// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's calls on the scheduling of a thread by its number: values are stored and returned, and have no effect.
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/files/machine.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/thread.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

// Null if it is not a simulated thread: then the system is asked.
Thread* thread_with(pid_t id) {
  if (!is_simulated()) return nullptr;
  if (id == 0) return &this_thread();
  return thread_with_id(id);
}

constexpr int least_niceness = -20, greatest_niceness = 19;

// Null for the process's first thread, whose niceness the system keeps.
Thread* later_thread_with(__priority_which_t which, id_t id) {
  if (which != PRIO_PROCESS) return nullptr;
  Thread* const thread = thread_with(static_cast<pid_t>(id));
  return thread != nullptr && thread->id != getpid() ? thread : nullptr;
}

id_t in_system(__priority_which_t which, id_t id) {
  return which == PRIO_USER ? id : static_cast<id_t>(family::in_system(static_cast<pid_t>(id)));
}

int niceness_of_process() { return WAITPOINT_NEXT(getpriority)(PRIO_PROCESS, 0); }

// The niceness of the other threads is relative to the process's, and stays as it is.
template <class Call>
int change_niceness_of_process(Call call) {
  if (!is_simulated()) return call();
  const int before = niceness_of_process();
  const int result = call();
  const ErrorNumberKept kept;
  const int by = niceness_of_process() - before;
  for (kernel::Task* task = first_task(); by != 0 && task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).id != getpid()) thread_of(*task).niceness -= by;
  return result;
}

bool is_priority_of(int policy, int priority) {
  const int least = sched_get_priority_min(policy);
  return least >= 0 && priority >= least && priority <= sched_get_priority_max(policy);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sched_setscheduler(pid_t id, int policy, const sched_param* parameters) noexcept {
  before_call<"sched_setscheduler">(changing(place::threads));
  Thread* const thread = thread_with(id);
  if (thread == nullptr) return WAITPOINT_NEXT(sched_setscheduler)(family::in_system(id), policy, parameters);
  const int plain = policy & ~SCHED_RESET_ON_FORK;
  if (parameters == nullptr) return fail(EINVAL);
  if (!can_be_read(parameters)) return fail(EFAULT);
  if (!is_priority_of(plain, parameters->sched_priority)) return fail(EINVAL);
  if (WAITPOINT_NEXT(geteuid)() != 0 && parameters->sched_priority > 0) return fail(EPERM);
  thread->policy = plain;
  thread->priority = parameters->sched_priority;
  return 0;
}
WAITPOINT_INTERPOSED int sched_getscheduler(pid_t id) noexcept {
  before_call<"sched_getscheduler">(reading(place::threads));
  const Thread* const thread = thread_with(id);
  return thread == nullptr ? WAITPOINT_NEXT(sched_getscheduler)(family::in_system(id)) : thread->policy;
}
WAITPOINT_INTERPOSED int sched_setparam(pid_t id, const sched_param* parameters) noexcept {
  const Thread* const thread = thread_with(id);
  if (thread == nullptr) return WAITPOINT_NEXT(sched_setparam)(family::in_system(id), parameters);
  return sched_setscheduler(id, thread->policy, parameters);
}
WAITPOINT_INTERPOSED int sched_getparam(pid_t id, sched_param* parameters) noexcept {
  before_call<"sched_getparam">(reading(place::threads));
  const Thread* const thread = thread_with(id);
  if (thread == nullptr) return WAITPOINT_NEXT(sched_getparam)(family::in_system(id), parameters);
  if (parameters == nullptr) return fail(EINVAL);
  if (!can_be_written(parameters, sizeof *parameters)) return fail(EFAULT);
  *parameters = {thread->priority};
  return 0;
}

// SCHED_RR's interval; for other policies the system's answer.
WAITPOINT_INTERPOSED int sched_rr_get_interval(pid_t id, timespec* interval) noexcept {
  const Thread* const thread = thread_with(id);
  if (thread == nullptr || thread->policy != SCHED_RR)
    return WAITPOINT_NEXT(sched_rr_get_interval)(family::in_system(id), interval);
  if (!can_be_written(interval, sizeof *interval)) return fail(EFAULT);
  *interval = {0, 100'000'000};
  return 0;
}

WAITPOINT_INTERPOSED int sched_setaffinity(pid_t id, std::size_t size, const cpu_set_t* set) noexcept {
  Thread* const thread = thread_with(id);
  if (thread == nullptr) return WAITPOINT_NEXT(sched_setaffinity)(family::in_system(id), size, set);
  const int error = pthread_setaffinity_np(reinterpret_cast<pthread_t>(thread->area), size, set);
  return error == 0 ? 0 : fail(error);
}
WAITPOINT_INTERPOSED int sched_getaffinity(pid_t id, std::size_t size, cpu_set_t* set) noexcept {
  const Thread* const thread = thread_with(id);
  if (thread == nullptr || !thread->has_processors)
    return WAITPOINT_NEXT(sched_getaffinity)(thread == nullptr ? family::in_system(id) : 0, size, set);
  const int error = pthread_getaffinity_np(reinterpret_cast<pthread_t>(thread->area), size, set);
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int getpriority(__priority_which_t which, id_t id) noexcept {
  before_call<"getpriority">(reading(place::threads));
  const Thread* const thread = later_thread_with(which, id);
  return thread == nullptr ? WAITPOINT_NEXT(getpriority)(which, in_system(which, id))
                           : niceness_of_process() + thread->niceness;
}
WAITPOINT_INTERPOSED int setpriority(__priority_which_t which, id_t id, int to) noexcept {
  before_call<"setpriority">(changing(place::threads));
  Thread* const thread = later_thread_with(which, id);
  if (thread == nullptr)
    return change_niceness_of_process([&] { return WAITPOINT_NEXT(setpriority)(which, in_system(which, id), to); });
  to = to < least_niceness ? least_niceness : to > greatest_niceness ? greatest_niceness : to;
  const int of_process = niceness_of_process();
  if (WAITPOINT_NEXT(geteuid)() != 0 && to < of_process + thread->niceness) return fail(EACCES);
  thread->niceness = to - of_process;
  return 0;
}
WAITPOINT_INTERPOSED int nice(int by) noexcept {
  before_call<"nice">(changing(place::threads));
  if (!is_simulated() || this_thread().id == getpid())
    return change_niceness_of_process([&] { return WAITPOINT_NEXT(nice)(by); });
  const id_t own = static_cast<id_t>(this_thread().id);
  if (setpriority(PRIO_PROCESS, own, getpriority(PRIO_PROCESS, own) + by) != 0) return fail(EPERM);
  return getpriority(PRIO_PROCESS, own);
}

// Always the same processor: the real one does not follow from the seed.
WAITPOINT_INTERPOSED int sched_getcpu() noexcept { return is_simulated() ? 0 : WAITPOINT_NEXT(sched_getcpu)(); }
WAITPOINT_INTERPOSED int getcpu(unsigned* processor, unsigned* node) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(getcpu)(processor, node);
  if (processor != nullptr) *processor = 0;
  if (node != nullptr) *node = 0;
  return 0;
}

// Processor time is virtual. The system's other counts do not follow from the seed.
WAITPOINT_INTERPOSED int getrusage(__rusage_who_t who, rusage* usage) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(getrusage)(who, usage);
  const int of = static_cast<int>(who);
  if (of != RUSAGE_SELF && of != RUSAGE_THREAD && of != RUSAGE_CHILDREN) return fail(EINVAL);
  if (!can_be_written(usage)) return fail(EFAULT);
  const clockid_t clock = of == RUSAGE_SELF ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID;
  const timespec spent = of == RUSAGE_CHILDREN ? timespec{} : to_timespec(reading_ns(clock, read_clock()));
  *usage = {};
  usage->ru_utime = {spent.tv_sec, spent.tv_nsec / 1000};
  usage->ru_maxrss = process_memory_bytes / 1024;
  return 0;
}
