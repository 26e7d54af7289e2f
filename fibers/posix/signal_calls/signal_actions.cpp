// SPDX-License-Identifier: BSD-3-Clause
//
// Actions of signals: sigaction() and the like.
#include <signal.h>

#include <cerrno>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

using Handler = void (*)(int);

Handler set_handler(int signal, Handler handler, int flags) {
  struct sigaction action {
  }, old{};
  action.sa_handler = handler;
  action.sa_flags = flags;
  if (handler == SIG_ERR || sigaction(signal, &action, &old) != 0) {
    errno = EINVAL;
    return SIG_ERR;
  }
  return old.sa_handler;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sigaction(int signal, const struct sigaction* action, struct sigaction* old) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(sigaction)(signal, action, old);
  if (!is_signal(signal) || signal == 32 || signal == 33) return fail(EINVAL);
  if (action != nullptr && contains(unblockable, signal)) return fail(EINVAL);
  before_call<"sigaction">(action != nullptr ? changing(place::signals) : reading(place::signals));
  Program& program = program_now();
  ProgramSignals& signals = program.signals;
  struct sigaction& known = signals.actions[signal];
  const struct sigaction before = known;
  if (action != nullptr) {
    known = *action;
    if (signal == SIGCHLD && family::own != nullptr)
      family::own->drops_children = known.sa_handler == SIG_IGN || (known.sa_flags & SA_NOCLDWAIT) != 0;
    known.sa_mask = to_sigset(to_set(action->sa_mask) & ~unblockable);
    if (contains(signals.interrupting, signal) && (action->sa_flags & SA_RESTART) != 0)
      signals.interrupting &= ~only(signal);
    install(signal);
    // Pending signals that are ignored from now on are dropped.
    if (is_simulated() && signals.is_discarded(signal)) {
      signals.pending.drop(only(signal));
      for (kernel::Task* task = first_task(); task != nullptr; task = task->next)
        if (is_thread(*task) && thread_of(*task).program == &program) thread_of(*task).pending.drop(only(signal));
    }
  }
  if (old != nullptr) *old = before;
  return 0;
}
WAITPOINT_INTERPOSED int __sigaction(int signal, const struct sigaction* action, struct sigaction* old) noexcept {
  return sigaction(signal, action, old);
}

WAITPOINT_INTERPOSED Handler signal(int signal, Handler handler) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(signal)(signal, handler);
  struct sigaction action {
  }, old{};
  if (!is_signal(signal)) {
    errno = EINVAL;
    return SIG_ERR;
  }
  action.sa_mask = to_sigset(only(signal));
  action.sa_handler = handler;
  action.sa_flags = contains(program_now().signals.interrupting, signal) ? 0 : SA_RESTART;
  if (handler == SIG_ERR || sigaction(signal, &action, &old) != 0) {
    errno = EINVAL;
    return SIG_ERR;
  }
  return old.sa_handler;
}
WAITPOINT_INTERPOSED Handler bsd_signal(int number, Handler handler) noexcept { return signal(number, handler); }
WAITPOINT_INTERPOSED Handler ssignal(int number, Handler handler) noexcept { return signal(number, handler); }
WAITPOINT_INTERPOSED Handler __sysv_signal(int signal, Handler handler) noexcept {
  return set_handler(signal, handler, static_cast<int>(SA_RESETHAND) | SA_NODEFER);
}
WAITPOINT_INTERPOSED Handler sysv_signal(int signal, Handler handler) noexcept {
  return __sysv_signal(signal, handler);
}
WAITPOINT_INTERPOSED int sigignore(int signal) noexcept {
  return set_handler(signal, SIG_IGN, 0) == SIG_ERR ? fail(EINVAL) : 0;
}

WAITPOINT_INTERPOSED int siginterrupt(int number, int flag) noexcept {
  struct sigaction action {};
  if (sigaction(number, nullptr, &action) != 0) return -1;
  SignalSet& interrupting = program_now().signals.interrupting;
  if (flag != 0)
    interrupting |= only(number), action.sa_flags &= ~SA_RESTART;
  else
    interrupting &= ~only(number), action.sa_flags |= SA_RESTART;
  return contains(unblockable, number) ? fail(EINVAL) : sigaction(number, &action, nullptr);
}
