// SPDX-License-Identifier: BSD-3-Clause
//
// The numbers of processes, groups and sessions are the family's own, the same in every run. The system's groups
// follow, as they decide which process a terminal's signals reach.
#include <sys/syscall.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

using family::Process;

/// The calling process, for 0.
Process* asked(pid_t id) { return id == 0 ? family::own : family::find(id); }

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED pid_t getpid() noexcept { return family::this_process(); }
// Programs poll it for the end of their parent.
WAITPOINT_INTERPOSED pid_t getppid() noexcept {
  before_call<"getppid">(reading(place::process));
  if (is_simulated()) read_clock();
  return family::own != nullptr ? family::own->parent : static_cast<pid_t>(WAITPOINT_NEXT(syscall)(SYS_getppid));
}

WAITPOINT_INTERPOSED pid_t getpgid(pid_t id) noexcept {
  before_call<"getpgid">(reading(place::process));
  if (family::own == nullptr) return WAITPOINT_NEXT(getpgid)(id);
  const Process* const process = asked(id);
  return process != nullptr ? process->group : fail(ESRCH);
}
WAITPOINT_INTERPOSED pid_t __getpgid(pid_t id) noexcept { return getpgid(id); }
WAITPOINT_INTERPOSED pid_t getpgrp() noexcept { return getpgid(0); }

WAITPOINT_INTERPOSED int setpgid(pid_t id, pid_t group) noexcept {
  before_call<"setpgid">(changing(place::process));
  if (family::own == nullptr) return WAITPOINT_NEXT(setpgid)(id, group);
  Process* const process = asked(id);
  if (group < 0) return fail(EINVAL);
  if (process == nullptr || (process != family::own && process->parent != family::own->id)) return fail(ESRCH);
  if (group == 0) group = process->id;
  if (process->session == process->id || process->session != family::own->session) return fail(EPERM);
  const Process* const leader = family::find(group);
  if (group != process->id && (leader == nullptr || leader->session != process->session)) return fail(EPERM);
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(setpgid)(process->real_id, leader != nullptr ? leader->real_id.load() : 0);
  process->group = group;
  return 0;
}
WAITPOINT_INTERPOSED int setpgrp() noexcept { return setpgid(0, 0); }

WAITPOINT_INTERPOSED pid_t getsid(pid_t id) noexcept {
  before_call<"getsid">(reading(place::process));
  if (family::own == nullptr) return WAITPOINT_NEXT(getsid)(id);
  const Process* const process = asked(id);
  return process != nullptr ? process->session : fail(ESRCH);
}

WAITPOINT_INTERPOSED pid_t setsid() noexcept {
  before_call<"setsid">(changing(place::process));
  if (family::own == nullptr) return WAITPOINT_NEXT(setsid)();
  Process& process = *family::own;
  for (const Process& each : family::entries())
    if (each.state != Process::State::none && each.group == process.id) return fail(EPERM);
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(setsid)();
  process.group = process.session = process.id;
  return process.id;
}

WAITPOINT_INTERPOSED pid_t tcgetpgrp(int terminal) noexcept {
  const pid_t real = WAITPOINT_NEXT(tcgetpgrp)(terminal);
  if (family::own == nullptr || real <= 0) return real;
  const Process* const leader = family::find_in_system(real);
  return leader != nullptr ? leader->group : family::family->processes[0].group;
}
WAITPOINT_INTERPOSED int tcsetpgrp(int terminal, pid_t group) noexcept {
  return WAITPOINT_NEXT(tcsetpgrp)(terminal, family::in_system(group));
}
