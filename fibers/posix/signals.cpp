// SPDX-License-Identifier: BSD-3-Clause
//
// Signals that are waited for, and those that one thread sends another. A handler runs in the thread that it was sent
// to, at its next waitpoint; what comes from outside runs in whichever thread does.
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "fibers/posix/cancellation.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/waiting.hpp"

namespace waitpoint::posix {
namespace {

constexpr timespec no_time = {0, 0};

bool has_handler(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN;
}

bool is_blocked(int signal) {
  sigset_t mask;
  return sigprocmask(SIG_SETMASK, nullptr, &mask) == 0 && sigismember(&mask, signal) == 1;
}

// Until one of the set is pending: it is taken. -1 with EAGAIN at the deadline.
int take(const sigset_t* set, siginfo_t* information, Time deadline) {
  const CancellationPoint point;
  pass(kernel::Operation::wait, nullptr);
  int taken = WAITPOINT_NEXT(sigtimedwait)(set, information, &no_time);
  if (taken < 0 && errno == EAGAIN) {
    const int descriptor = signalfd(-1, set, SFD_CLOEXEC | SFD_NONBLOCK);
    if (descriptor < 0) return -1;
    note_inside(descriptor, false);
    wait_for(descriptor, POLLIN, deadline);
    WAITPOINT_NEXT(close)(descriptor);
    leave_if_cancelled();
    taken = WAITPOINT_NEXT(sigtimedwait)(set, information, &no_time);
  }
  return taken;
}

}  // namespace

void deliver_signals(kernel::Task& task) {
  Thread& thread = thread_of(task);
  task.scheduler->attend(task, kernel::attention::signal, false);
  while (thread.signals != 0) {
    const int signal = __builtin_ctzll(thread.signals) + 1;
    thread.signals &= thread.signals - 1;
    raise(signal);
  }
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sigtimedwait(const sigset_t* set, siginfo_t* information, const timespec* timeout) {
  if (!is_simulated()) return WAITPOINT_NEXT(sigtimedwait)(set, information, timeout);
  if (timeout != nullptr && !is_valid(*timeout)) return fail(EINVAL);
  return take(set, information,
              timeout == nullptr ? Time::max() : later(kernel::local_time(*kernel::running), span(*timeout)));
}

WAITPOINT_INTERPOSED int sigwaitinfo(const sigset_t* set, siginfo_t* information) {
  return sigtimedwait(set, information, nullptr);
}

WAITPOINT_INTERPOSED int sigwait(const sigset_t* set, int* signal) {
  if (!is_simulated()) return WAITPOINT_NEXT(sigwait)(set, signal);
  int taken = 0;
  do {
    taken = take(set, nullptr, Time::max());
  } while (taken < 0 && (errno == EINTR || errno == EAGAIN));
  if (taken < 0) return errno;
  *signal = taken;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_kill(pthread_t id, int signal) noexcept {
  Thread* const thread = find(id);
  if (thread == nullptr) return ESRCH;
  if (signal < 0 || signal > SIGRTMAX) return EINVAL;
  if (signal == 0 || thread->ended) return 0;
  pass(kernel::Operation::signal, &thread->end);
  if (thread->ended) return 0;
  // What is blocked stays pending, for whoever waits for it; what has no handler is for the whole process.
  if (thread == &this_thread() || is_blocked(signal) || !has_handler(signal)) {
    const int result = raise(signal) == 0 ? 0 : errno;
    look_at_descriptors();
    return result;
  }
  thread->signals |= std::uint64_t{1} << (signal - 1);
  thread->task->scheduler->attend(*thread->task, kernel::attention::signal, true);
  return 0;
}
