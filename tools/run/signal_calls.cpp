// SPDX-License-Identifier: BSD-3-Clause
//
// In place of the C library's functions for signal masks and dispositions: model code cannot block the signals by which
// a run is watched, interrupted and reported, as a driver's thread does that blocks all signals at its beginning, nor
// give those of faults their default effect, as libraries with crash handlers do. All else is as it was: handlers of
// the model's own are installed, and other threads are not concerned.
#include <pthread.h>

#include <csignal>

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "tools/run/next_definition.hpp"

using waitpoint::tools::next_definition;

namespace {

/// Of the watchdog (run_watchdog.cpp) and of interruptions (interruption.cpp).
constexpr int watching = SIGURG, interrupting[] = {SIGINT, SIGTERM, SIGHUP};

bool is_model_call() { return waitpoint::kernel::in_model_code() && !waitpoint::sync::has_program_layer(); }

bool is_of_fault(int signal) {
  for (const int fault : waitpoint::kernel::FaultReports::signals)
    if (fault == signal) return true;
  return false;
}

/// Dispositions that would take the signal from the run.
bool is_kept(int signal, void (*handler)(int)) {
  if (!is_model_call()) return false;
  return signal == watching || (is_of_fault(signal) && (handler == SIG_DFL || handler == SIG_IGN));
}

/// The signals that model code may block.
sigset_t blockable(sigset_t set) {
  for (const int signal : waitpoint::kernel::FaultReports::signals) sigdelset(&set, signal);
  for (const int signal : interrupting) sigdelset(&set, signal);
  sigdelset(&set, watching);
  return set;
}

using SetMask = int(int, const sigset_t*, sigset_t*);

int set_mask(const char* name, int how, const sigset_t* set, sigset_t* old) {
  if (set == nullptr || how == SIG_UNBLOCK || !is_model_call()) return next_definition<SetMask>(name)(how, set, old);
  const sigset_t allowed = blockable(*set);
  return next_definition<SetMask>(name)(how, &allowed, old);
}

}  // namespace

extern "C" {

int sigprocmask(int how, const sigset_t* set, sigset_t* old) { return set_mask("sigprocmask", how, set, old); }
int pthread_sigmask(int how, const sigset_t* set, sigset_t* old) { return set_mask("pthread_sigmask", how, set, old); }

int sigaction(int number, const struct sigaction* action, struct sigaction* old) {
  const bool keeps = action != nullptr && is_kept(number, action->sa_handler);
  return next_definition<int(int, const struct sigaction*, struct sigaction*)>("sigaction")(
      number, keeps ? nullptr : action, old);
}

sighandler_t signal(int number, sighandler_t handler) {
  if (!is_kept(number, handler)) return next_definition<sighandler_t(int, sighandler_t)>("signal")(number, handler);
  struct sigaction present {};
  sigaction(number, nullptr, &present);
  return present.sa_handler;
}

}  // extern "C"
