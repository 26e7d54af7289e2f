// SPDX-License-Identifier: BSD-3-Clause
//
// In place of the C library's functions for signal masks and dispositions: model code cannot block the signals by which
// a run is watched, interrupted and reported, as a driver's thread does that blocks all signals at its beginning, nor
// take the stack of their handlers, nor give those of faults their default effect, as libraries with crash handlers do;
// faults of other threads are reported, too. All else is as it was: handlers of the model's own are installed.
//
// In place of the functions that send signals: SIGKILL to the own process is reported before it is sent.
#include <pthread.h>
#include <unistd.h>

#include <csignal>

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/unfinished_run.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "tools/run/next_definition.hpp"

using waitpoint::tools::next_definition;

namespace {

/// Of the watchdog (run_watchdog.cpp) and of interruptions (interruption.cpp).
constexpr int watching = SIGURG, interrupting[] = {SIGINT, SIGTERM, SIGHUP};

bool is_model_call() { return waitpoint::kernel::in_model_code() && !waitpoint::sync::has_program_layer(); }
/// Also in other threads.
bool is_call_in_run() {
  return (waitpoint::kernel::in_unfinished_run() || waitpoint::kernel::in_model_code()) &&
         !waitpoint::sync::has_program_layer();
}

bool is_of_fault(int signal) {
  for (const int fault : waitpoint::kernel::FaultReports::signals)
    if (fault == signal) return true;
  return false;
}

bool is_interrupting(int signal) {
  for (const int each : interrupting)
    if (each == signal) return true;
  return false;
}

/// Dispositions that would take the signal from the run.
bool is_kept(int signal, void (*handler)(int)) {
  if (signal == watching) return is_model_call();
  if (handler == SIG_DFL && is_interrupting(signal)) return is_call_in_run();
  return is_of_fault(signal) && (handler == SIG_DFL || handler == SIG_IGN) && is_call_in_run();
}

/// The signals that the thread may block.
sigset_t blockable(sigset_t set) {
  for (const int signal : waitpoint::kernel::FaultReports::signals) sigdelset(&set, signal);
  if (!is_model_call()) return set;
  for (const int signal : interrupting) sigdelset(&set, signal);
  sigdelset(&set, watching);
  return set;
}

void note_own(int signal) { waitpoint::kernel::note_signal_to(getpid(), signal); }

using SetMask = int(int, const sigset_t*, sigset_t*);

int set_mask(const char* name, int how, const sigset_t* set, sigset_t* old) {
  if (set == nullptr || how == SIG_UNBLOCK || !is_call_in_run()) return next_definition<SetMask>(name)(how, set, old);
  const sigset_t allowed = blockable(*set);
  return next_definition<SetMask>(name)(how, &allowed, old);
}

}  // namespace

extern "C" {

int sigprocmask(int how, const sigset_t* set, sigset_t* old) { return set_mask("sigprocmask", how, set, old); }
int pthread_sigmask(int how, const sigset_t* set, sigset_t* old) { return set_mask("pthread_sigmask", how, set, old); }

int sigaction(int number, const struct sigaction* action, struct sigaction* old) {
  const bool keeps = action != nullptr && is_kept(number, action->sa_handler);
  const struct sigaction report = waitpoint::kernel::death_report();
  const bool is_reported =
      action != nullptr && action->sa_handler == SIG_DFL && waitpoint::kernel::ends_process(number) && is_call_in_run();
  return next_definition<int(int, const struct sigaction*, struct sigaction*)>("sigaction")(number,
                                                                                            keeps         ? nullptr
                                                                                            : is_reported ? &report
                                                                                                          : action,
                                                                                            old);
}

sighandler_t signal(int number, sighandler_t handler) {
  struct sigaction action {
  }, before{};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  return sigaction(number, &action, &before) == 0 ? before.sa_handler : SIG_ERR;
}

int sigaltstack(const stack_t* stack, stack_t* old) {
  return next_definition<int(const stack_t*, stack_t*)>("sigaltstack")(is_call_in_run() ? nullptr : stack, old);
}

int raise(int number) {
  note_own(number);
  return next_definition<int(int)>("raise")(number);
}
int pthread_kill(pthread_t thread, int number) {
  note_own(number);
  return next_definition<int(pthread_t, int)>("pthread_kill")(thread, number);
}
int pthread_sigqueue(pthread_t thread, int number, const sigval value) {
  note_own(number);
  return next_definition<int(pthread_t, int, sigval)>("pthread_sigqueue")(thread, number, value);
}
int kill(pid_t process, int number) {
  waitpoint::kernel::note_signal_to(process, number);
  return next_definition<int(pid_t, int)>("kill")(process, number);
}
int killpg(pid_t group, int number) {
  waitpoint::kernel::note_signal_to(-group, number);
  return next_definition<int(pid_t, int)>("killpg")(group, number);
}
int tgkill(pid_t process, pid_t thread, int number) {
  waitpoint::kernel::note_signal_to(process, number);
  return next_definition<int(pid_t, pid_t, int)>("tgkill")(process, thread, number);
}
int sigqueue(pid_t process, int number, const sigval value) {
  waitpoint::kernel::note_signal_to(process, number);
  return next_definition<int(pid_t, int, sigval)>("sigqueue")(process, number, value);
}

}  // extern "C"
