// SPDX-License-Identifier: BSD-3-Clause
//
// fork(): the child becomes a simulation of its own, with the calling thread; programs that it starts are not
// simulated. And waiting for children, which run in real time.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/input_output/asynchronous.hpp"
#include "fibers/posix/ipc/named_objects.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/processes/children.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/futex_vectors.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/threads/thread.hpp"
#include "fibers/posix/timers/interval_timers.hpp"
#include "fibers/posix/timers/notification_threads.hpp"

namespace waitpoint::posix {
namespace {

// `waitpoint exec` does not watch the child, which gets a copy of the record at the same address. The copy is made
// before the fork, as the parent continues at once.
static_assert(record_address % 4096 == 0 && record_bytes % 4096 == 0 && sizeof(Record) <= record_bytes);
void* copy_of_record = nullptr;

void copy_record() {
  if (!is_simulated() || copy_of_record != nullptr) return;
  share_named_semaphores();
  family::expect_child();
  void* const copy =
      mmap(nullptr, record_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (copy == MAP_FAILED) refuse("there is no memory for a child's simulation");
  const auto used = static_cast<const char*>(record->arena.top()) - reinterpret_cast<const char*>(record);
  WAITPOINT_CHECK(
      used >= static_cast<std::ptrdiff_t>(sizeof(Record)) && used <= static_cast<std::ptrdiff_t>(record_bytes),
      "the record's arena reaches out of the record");
  std::memcpy(copy, static_cast<void*>(record), static_cast<std::size_t>(used));
  copy_of_record = copy;
}

void drop_copy() {
  if (copy_of_record != nullptr) munmap(copy_of_record, record_bytes);
  copy_of_record = nullptr;
}

void take_own_record() {
  const int flags = MREMAP_MAYMOVE | MREMAP_FIXED;
  if (mremap(copy_of_record, record_bytes, record_bytes, flags, record) == MAP_FAILED)
    refuse("there is no memory for a child's simulation");
  copy_of_record = nullptr;
}

void end_other_tasks() {
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  for (kernel::Task *task = scheduler.first_task(), *next = nullptr; task != nullptr; task = next) {
    next = task->next;
    if (task != kernel::running) scheduler.end_in_place(*task);
  }
  WAITPOINT_CHECK(first_task() == kernel::running && kernel::running->next == nullptr,
                  "a child has tasks of its parent's");
}

// In the child, before any handler of pthread_atfork() of the program's. The child has begun once it has the copy.
void begin_as_child() {
  if (!is_simulated() || copy_of_record == nullptr) return;
  take_own_record();
  family::begin_as_child();
  system_v::inherit_memory(getppid());
  forget_waiters();
  forget_vectors();
  leave_shared_mutexes();
  end_other_tasks();
  forget_interval_timers();
  forget_timers();
  forget_notices();
  forget_asynchronous_requests();
  forget_pending_signals();
  begin_again_as_first(this_thread());
  note_parent();
}

/// The children and the events that a call waits for.
struct Awaited {
  idtype_t type;
  id_t id;
  int options;  // of waitid()
};

bool has_news(const void* what) {
  const auto& awaited = *static_cast<const Awaited*>(what);
  const ErrorNumberKept kept;
  siginfo_t information{};
  const int result =
      WAITPOINT_NEXT(waitid)(awaited.type, awaited.id, &information, awaited.options | WNOHANG | WNOWAIT);
  return result != 0 || information.si_pid != 0;
}

Awaited awaited_by(pid_t pid, int options) {
  Awaited awaited{P_ALL, 0, WEXITED | (options & (WUNTRACED | WCONTINUED))};
  if (pid > 0) awaited = {P_PID, static_cast<id_t>(pid), awaited.options};
  if (pid < -1) awaited = {P_PGID, static_cast<id_t>(-pid), awaited.options};
  if (pid == 0) awaited = {P_PGID, static_cast<id_t>(getpgrp()), awaited.options};
  return awaited;
}

// False, with EINTR, if a signal ended the wait.
bool wait_for_news(const Awaited& awaited) {
  const CancellationPoint point;
  pass(kernel::Operation::join, nullptr);
  const int result = wait_outside(has_news, &awaited, Restart::if_asked);
  leave_if_cancelled();
  return result >= 0;
}

}  // namespace

void before_child() {
  pass(kernel::Operation::start, nullptr);
  note_fork();
  // The end of a child is noticed even if no handler is set.
  signals_of_program.ever_blocked |= only(SIGCHLD);
  install(SIGCHLD);
}

pid_t fork_by(pid_t (*real)(const void*), const void* argument, bool calls_handlers) {
  before_child();
  if (!calls_handlers) copy_record();
  const pid_t child = real(argument);
  if (child == 0) begin_as_child();
  WAITPOINT_CHECK(child != 0 || copy_of_record == nullptr, "a child has not begun its own simulation");
  if (child != 0) {
    drop_copy();
    family::note_child(child);
  }
  if (child > 0) note_child(child);
  return child;
}

namespace {

// SIGCHLD comes before a wait reports the child's end.
void handle_what_came() {
  const ErrorNumberKept kept;
  take_in_signals_from_outside();
  if (deliverable(this_thread()) != 0) handle_signals();
}

}  // namespace

// No other handler runs between these and the fork: the one registered first is called last before a fork.
void register_fork() { pthread_atfork(copy_record, drop_copy, begin_as_child); }

bool is_guest() { return has_host && is_simulated(); }

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED pid_t fork() noexcept {
  if (is_guest()) return fail(ENOSYS);
  if (!is_simulated()) return WAITPOINT_NEXT(fork)();
  return fork_by([](const void*) { return WAITPOINT_NEXT(fork)(); }, nullptr, true);
}
WAITPOINT_INTERPOSED pid_t _Fork() noexcept {
  if (is_guest()) return fail(ENOSYS);
  if (!is_simulated()) return WAITPOINT_NEXT(_Fork)();
  return fork_by([](const void*) { return WAITPOINT_NEXT(_Fork)(); }, nullptr, false);
}

// The child does not share its parent's memory, but the parent waits for its end or exec, as programs may expect.
WAITPOINT_INTERPOSED pid_t vfork() noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(fork)();
  if (is_guest()) return fail(ENOSYS);
  int ends[2] = {-1, -1};
  if (WAITPOINT_NEXT(pipe2)(ends, O_CLOEXEC) != 0) return fork();
  constexpr int out_of_the_way = 512;
  for (int& end : ends)
    if (const int moved = fcntl(end, F_DUPFD_CLOEXEC, out_of_the_way); moved >= 0) {
      WAITPOINT_NEXT(close)(end);
      end = moved;
    }
  const pid_t child = fork();
  if (child == 0) {
    WAITPOINT_NEXT(close)(ends[0]);
    return 0;
  }
  WAITPOINT_NEXT(close)(ends[1]);
  const ErrorNumberKept kept;
  while (child > 0 && wait_for(ends[0], POLLIN, Time::max(), Restart::if_asked) < 0) {
  }
  WAITPOINT_NEXT(close)(ends[0]);
  return child;
}

WAITPOINT_INTERPOSED pid_t wait4(pid_t pid, int* status, int options, rusage* usage) {
  if (!is_simulated()) return WAITPOINT_NEXT(wait4)(pid, status, options, usage);
  if ((options & WNOHANG) != 0) {
    pass_cancellation_point();
    spend(cost_of_giving_way);  // a polling loop must end
    const InKernel within;
    kernel::running->scheduler->yield();
  } else if (!wait_for_news(awaited_by(pid, options))) {
    return -1;
  }
  const pid_t child = WAITPOINT_NEXT(wait4)(pid, status, options | WNOHANG, usage);
  handle_what_came();
  return child;
}

WAITPOINT_INTERPOSED pid_t waitpid(pid_t pid, int* status, int options) { return wait4(pid, status, options, nullptr); }
WAITPOINT_INTERPOSED pid_t wait(int* status) { return wait4(-1, status, 0, nullptr); }
WAITPOINT_INTERPOSED pid_t wait3(int* status, int options, rusage* usage) noexcept {
  return wait4(-1, status, options, usage);
}

WAITPOINT_INTERPOSED int waitid(idtype_t type, id_t id, siginfo_t* information, int options) {
  if (!is_simulated() || (options & WNOHANG) != 0) {
    pass_cancellation_point();
    return WAITPOINT_NEXT(waitid)(type, id, information, options);
  }
  if (!wait_for_news({type, id, options & ~WNOWAIT})) return -1;
  const int result = WAITPOINT_NEXT(waitid)(type, id, information, options | WNOHANG);
  handle_what_came();
  return result;
}
