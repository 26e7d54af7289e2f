// SPDX-License-Identifier: BSD-3-Clause
//
// Waiting for children: they end at an instant of virtual time. What they leave in the system is taken away with their
// status. Only children that execute programs that cannot be simulated end in real time.
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/process_descriptors.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

using family::Process;

/// The children and the events that a call waits for.
struct Awaited {
  idtype_t type;
  id_t id;
  int options;  // of waitid()

  bool includes(const Process& process) const {
    if (process.state == Process::State::none || process.parent != family::own->id) return false;
    return type == P_ALL || (type == P_PID && static_cast<id_t>(process.id) == id) ||
           (type == P_PGID && static_cast<id_t>(process.group) == id);
  }
};

long wait_in_system(pid_t process, int* status, int options) {
  return WAITPOINT_NEXT(syscall)(SYS_wait4, process, status, options, nullptr);
}

bool has_news(const Process& process, int options) {
  if (process.is_native && process.state == Process::State::alive) {
    siginfo_t information{};
    const int asked = (options & (WEXITED | WSTOPPED | WCONTINUED)) | WNOHANG | WNOWAIT | __WALL;
    WAITPOINT_NEXT(syscall)(SYS_waitid, P_PID, process.real_id.load(), &information, asked, nullptr);
    return information.si_pid != 0;
  }
  return ((options & WEXITED) != 0 && process.state == Process::State::ended) ||
         ((options & WSTOPPED) != 0 && process.is_unnoted) || ((options & WCONTINUED) != 0 && process.continued);
}

Process* child_with_news(const Awaited& awaited) {
  const ErrorNumberKept kept;
  for (Process& process : family::entries())
    if (awaited.includes(process) && has_news(process, awaited.options)) return &process;
  return nullptr;
}

/// The children that a call may wait for.
enum class Among { none, family, natives_too };
Among children_of(const Awaited& awaited) {
  Among among = Among::none;
  for (const Process& process : family::entries()) {
    if (!awaited.includes(process)) continue;
    if (process.is_native) return Among::natives_too;
    among = Among::family;
  }
  return among;
}

// Its status, which is reported once.
int take_note(Process& process, int options) {
  const bool stays = (options & WNOWAIT) != 0;
  int status = process.status;
  if (process.is_native && process.state == Process::State::alive) {
    if (stays || wait_in_system(process.real_id, &status, WNOHANG | WUNTRACED | WCONTINUED | __WALL) <= 0)
      return status;
    if (!WIFEXITED(status) && !WIFSIGNALED(status)) return status;
    // Those that wait at its descriptors' other ends look once more: without natives they wait for each other.
    family::remove(process);
    family::ring(family::of_anything);
    return status;
  }
  if (process.state != Process::State::ended) {
    if (!stays) process.is_unnoted = process.continued = false;
    return status;
  }
  if (stays) return status;
  int real = 0;
  long result = 0;
  do result = wait_in_system(process.real_id, &real, 0);
  while (result < 0 && errno == EINTR);
  if (result > 0) status = real;
  family::remove(process);
  return status;
}

/// Null with errno set: ECHILD, or EINTR; null with 0: no news, and the caller does not wait.
Process* await_news(const Awaited& awaited) {
  const CancellationPoint point;
  pass(kernel::Operation::join, nullptr);
  static constinit kernel::Object object{"child"};
  kernel::enter(object);
  const auto is_ready = [](const void* what) {
    const auto& asked = *static_cast<const Awaited*>(what);
    return child_with_news(asked) != nullptr || children_of(asked) == Among::none;
  };
  // A child may have executed a native program in the meantime.
  const auto is_ready_or_outside = [](const void* what) {
    const auto& asked = *static_cast<const Awaited*>(what);
    return child_with_news(asked) != nullptr || children_of(asked) != Among::family;
  };
  for (;;) {
    if (Process* const child = child_with_news(awaited); child != nullptr) return child;
    const Among among = children_of(awaited);
    errno = among == Among::none ? ECHILD : 0;
    if (among == Among::none) return nullptr;
    if ((awaited.options & WNOHANG) != 0) {
      spend(cost_of_giving_way);  // a polling loop must end
      const InKernel within;
      kernel::yield(*kernel::running->scheduler);
      errno = 0;
      return child_with_news(awaited);
    }
    if (among == Among::natives_too) {
      if (wait_outside(is_ready, &awaited, Restart::if_asked) < 0) return nullptr;
    } else if (wait_on_shared(object, Time::max(), is_ready_or_outside, &awaited) == Wait::interrupted &&
               is_interrupted(Restart::if_asked) && child_with_news(awaited) == nullptr) {
      errno = EINTR;
      return nullptr;
    }
    leave_if_cancelled();
  }
}

// SIGCHLD comes before a wait reports the child's end.
void handle_what_came() {
  const ErrorNumberKept kept;
  take_in_signals_from_outside();
  if (deliverable(this_thread()) != 0) handle_signals();
}

Awaited awaited_by(pid_t id, int options) {
  const int asked = WEXITED | (options & (WNOHANG | WUNTRACED | WCONTINUED));
  if (id > 0) return {P_PID, static_cast<id_t>(id), asked};
  if (id == -1) return {P_ALL, 0, asked};
  return {P_PGID, static_cast<id_t>(id == 0 ? family::own->group : -id), asked};
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED pid_t wait4(pid_t id, int* status, int options, rusage* usage) {
  if (!is_simulated() || family::own == nullptr) return WAITPOINT_NEXT(wait4)(id, status, options, usage);
  if ((options & ~(WNOHANG | WUNTRACED | WCONTINUED | __WALL | __WNOTHREAD | static_cast<int>(__WCLONE))) != 0)
    return fail(EINVAL);
  family::Process* const child = await_news(awaited_by(id, options));
  if (child == nullptr) return errno == 0 ? 0 : -1;
  const pid_t found = child->id;
  const int ended = take_note(*child, options);
  if (status != nullptr) *status = ended;
  if (usage != nullptr) *usage = {};
  handle_what_came();
  return found;
}

WAITPOINT_INTERPOSED pid_t waitpid(pid_t id, int* status, int options) { return wait4(id, status, options, nullptr); }
WAITPOINT_INTERPOSED pid_t wait(int* status) { return wait4(-1, status, 0, nullptr); }
WAITPOINT_INTERPOSED pid_t wait3(int* status, int options, rusage* usage) noexcept {
  return wait4(-1, status, options, usage);
}

WAITPOINT_INTERPOSED int waitid(idtype_t type, id_t id, siginfo_t* information, int options) {
  constexpr int events = WEXITED | WSTOPPED | WCONTINUED, known = events | WNOHANG | WNOWAIT;
  if (!is_simulated() || family::own == nullptr) return WAITPOINT_NEXT(waitid)(type, id, information, options);
  if (type == static_cast<idtype_t>(P_PIDFD)) {
    const pid_t process = process_of(static_cast<int>(id));
    if (process < 0) return fail(static_cast<int>(id) < 0 ? EINVAL : EBADF);
    type = P_PID;
    id = static_cast<id_t>(process);
  }
  if ((options & events) == 0 || (options & ~known) != 0 || type > P_PGID) return fail(EINVAL);
  if (type == P_PGID && id == 0) id = static_cast<id_t>(family::own->group);
  family::Process* const child = await_news({type, id, options});
  if (information != nullptr) *information = {};
  if (child == nullptr) return errno == 0 ? 0 : -1;
  const pid_t found = child->id;
  const int status = take_note(*child, options);
  if (information != nullptr) {
    information->si_signo = SIGCHLD;
    information->si_pid = found;
    information->si_uid = getuid();
    information->si_code = WIFEXITED(status)      ? CLD_EXITED
                           : WIFSTOPPED(status)   ? CLD_STOPPED
                           : WIFCONTINUED(status) ? CLD_CONTINUED
                           : WCOREDUMP(status)    ? CLD_DUMPED
                                                  : CLD_KILLED;
    information->si_status = WIFEXITED(status)      ? WEXITSTATUS(status)
                             : WIFSTOPPED(status)   ? WSTOPSIG(status)
                             : WIFCONTINUED(status) ? SIGCONT
                                                    : WTERMSIG(status);
  }
  handle_what_came();
  return 0;
}
