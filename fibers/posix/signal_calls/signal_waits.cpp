// SPDX-License-Identifier: BSD-3-Clause
//
// Waiting for signals, with a handler or without. As signals may come from outside, such a wait is no deadlock.
#include <unistd.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/signals/temporary_mask.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

kernel::Object signals_object{"signal"};

Wait wait_for_signal(const CancellationPoint& point, Time deadline) {
  kernel::enter(signals_object);
  const WaitsOutside outside;
  return point.block(signals_object, deadline);
}

// Waits until one of the set is pending and takes it; or returns a negated error number.
int take(SignalSet set, siginfo_t* information, Time deadline) {
  const CancellationPoint point;
  pass(kernel::Operation::wait, nullptr);
  set &= ~unblockable;
  Thread& thread = this_thread();
  siginfo_t taken{};
  for (;;) {
    take_in_signals_from_outside();
    if (const int signal = take_pending(set, taken); signal != 0) {
      if (taken.si_code == SI_TKILL) taken.si_code = SI_USER;  // as in the C library
      if (information != nullptr) *information = taken;
      return signal;
    }
    if (deadline <= kernel::running->local_time) return -EAGAIN;
    WAITPOINT_CHECK(thread.awaited == 0, "a thread that waits for signals waits for others already");
    thread.awaited = set;
    const Wait ended = wait_for_signal(point, deadline);
    thread.awaited = 0;
    leave_if_cancelled();
    if (ended != Wait::interrupted) continue;
    if ((set & pending_for(thread)) == 0 && is_interrupted(Restart::never)) return -EINTR;
  }
}

// Waits until a handler has run, be it at the call's own waitpoint.
int suspend_with(SignalSet blocked) {
  const TemporaryMask mask(blocked);
  const CancellationPoint point;
  pass(kernel::Operation::wait, nullptr);
  for (;;) {
    if (mask.was_left()) return fail(EINTR);
    wait_for_signal(point, Time::max());
    leave_if_cancelled();
    if (is_interrupted(Restart::never)) return fail(EINTR);
  }
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sigtimedwait(const sigset_t* set, siginfo_t* information, const timespec* timeout) {
  if (!is_simulated()) return WAITPOINT_NEXT(sigtimedwait)(set, information, timeout);
  if (!can_be_read(set) || (timeout != nullptr && !can_be_read(timeout))) return fail(EFAULT);
  if (timeout != nullptr && (!is_valid(*timeout) || timeout->tv_sec < 0)) return fail(EINVAL);
  const Time deadline = timeout == nullptr ? Time::max() : later(kernel::local_time(*kernel::running), span(*timeout));
  const int taken = take(to_set(*set), information, deadline);
  if (taken == -EAGAIN) read_clock();  // a polling loop must end
  return taken > 0 ? taken : fail(-taken);
}

WAITPOINT_INTERPOSED int sigwaitinfo(const sigset_t* set, siginfo_t* information) {
  return sigtimedwait(set, information, nullptr);
}

WAITPOINT_INTERPOSED int sigwait(const sigset_t* set, int* signal) {
  if (!is_simulated()) return WAITPOINT_NEXT(sigwait)(set, signal);
  if (!can_be_read(set)) return EFAULT;
  int taken = 0;
  while ((taken = take(to_set(*set), nullptr, Time::max())) < 0) {
  }
  *signal = taken;
  return 0;
}

WAITPOINT_INTERPOSED int sigsuspend(const sigset_t* set) {
  if (!is_simulated()) return WAITPOINT_NEXT(sigsuspend)(set);
  return can_be_read(set) ? suspend_with(to_set(*set)) : fail(EFAULT);
}

WAITPOINT_INTERPOSED int pause() {
  return is_simulated() ? suspend_with(this_thread().blocked) : WAITPOINT_NEXT(pause)();
}

// X/Open's takes a signal, BSD's (by a macro) a mask.
WAITPOINT_INTERPOSED int __xpg_sigpause(int signal) {
  if (!is_signal(signal)) return fail(EINVAL);
  return suspend_with(this_thread().blocked & ~only(signal));
}
WAITPOINT_INTERPOSED int __sigpause(int signal_or_mask, int is_signal) {
  return is_signal != 0 ? __xpg_sigpause(signal_or_mask) : suspend_with(static_cast<unsigned>(signal_or_mask));
}
// The header maps sigpause() to X/Open's.
extern "C" [[gnu::visibility("default")]] int waitpoint_sigpause(int mask) __asm__("sigpause");
int waitpoint_sigpause(int mask) { return __sigpause(mask, 0); }
