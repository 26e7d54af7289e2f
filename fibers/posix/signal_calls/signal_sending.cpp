// SPDX-License-Identifier: BSD-3-Clause
//
// Signals that the program sends. Those to itself are simulated; those to other processes go to the system.
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

extern "C" {
#include <sys/pidfd.h>  // has no extern "C"
}

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/process_descriptors.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

// Signals to this thread are handled before the call returns.
void handle_own() {
  kernel::Task& task = *kernel::running;
  if ((task.attention & kernel::attention::signal) == 0) return;
  task.scheduler->attend(task, kernel::attention::signal, false);
  handle_signals();
}

int send_here(const siginfo_t& information, Thread* to) {
  WAITPOINT_CHECK(is_signal(information.si_signo), "a number is sent that is no signal");
  WAITPOINT_CHECK(to == nullptr || to->task != nullptr, "a signal is sent to a thread that has ended");
  if (contains(only(SIGKILL) | only(SIGSTOP), information.si_signo)) {
    do_default(information.si_signo);
    return 0;
  }
  if (!send(information, to)) return EAGAIN;
  handle_own();
  return 0;
}

bool is_number(int signal) { return signal == 0 || is_signal(signal); }

// Returns an error number.
int send_to_thread(Thread* thread, siginfo_t information) {
  if (thread == nullptr) return ESRCH;
  if (!is_number(information.si_signo)) return EINVAL;
  if (thread->ended) return 0;
  if (information.si_signo == 0) return 0;
  pass(kernel::Operation::signal, &thread->end);
  return thread->ended ? 0 : send_here(information, thread);
}

siginfo_t with_value(int signal, sigval value) {
  siginfo_t information = from_here(signal, SI_QUEUE);
  information.si_value = value;
  return information;
}

// Linux's limit of pending signals of a user.
bool is_queue_full() {
  rlimit limit{};
  getrlimit(RLIMIT_SIGPENDING, &limit);
  return limit.rlim_cur == 0;
}

}  // namespace

int send_as_told(const siginfo_t& information) {
  if (information.si_signo == 0) return 0;
  if (!is_signal(information.si_signo)) return EINVAL;
  if (is_queue_full()) return EAGAIN;
  pass(kernel::Operation::signal, nullptr);
  return send_here(information, nullptr);
}

int send_as_told(const siginfo_t& information, int id) {
  if (id <= 0) return EINVAL;
  return send_to_thread(thread_with_id(id), information);
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int kill(pid_t process, int signal) noexcept {
  if (!is_simulated() || process != getpid() || !is_signal(signal)) {
    const int result = WAITPOINT_NEXT(kill)(process, signal);
    // This process may be among the receivers.
    if (is_simulated() && process <= 0 && take_in_signals_from_outside()) handle_signals();
    return result;
  }
  pass(kernel::Operation::signal, nullptr);
  const int error = send_here(from_here(signal, SI_USER), nullptr);
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int killpg(pid_t group, int signal) noexcept {
  return group < 0 ? fail(EINVAL) : kill(-group, signal);
}

WAITPOINT_INTERPOSED int raise(int signal) noexcept {
  if (!is_simulated() || !is_signal(signal)) return WAITPOINT_NEXT(raise)(signal);
  const int error = send_to_thread(&this_thread(), from_here(signal, SI_TKILL));
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int tgkill(pid_t process, pid_t thread, int signal) noexcept {
  if (!is_simulated() || process != getpid()) return WAITPOINT_NEXT(tgkill)(process, thread, signal);
  if (thread <= 0) return fail(EINVAL);
  const int error = send_to_thread(thread_with_id(thread), from_here(signal, SI_TKILL));
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int sigqueue(pid_t process, int signal, sigval value) noexcept {
  if (!is_simulated() || process != getpid() || !is_signal(signal))
    return WAITPOINT_NEXT(sigqueue)(process, signal, value);
  const int error = send_as_told(with_value(signal, value));
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int pidfd_send_signal(int process, int signal, siginfo_t* information, unsigned flags) noexcept {
  const bool is_told = information == nullptr || (can_be_read(information) && information->si_signo == signal);
  if (!is_simulated() || flags != 0 || !is_told || process_of(process) != getpid())
    return WAITPOINT_NEXT(pidfd_send_signal)(process, signal, information, flags);
  const int error = send_as_told(information != nullptr ? *information : from_here(signal, SI_USER));
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int pthread_kill(pthread_t id, int signal) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(pthread_kill)(id, signal);
  return send_to_thread(find(id), from_here(signal, SI_TKILL));
}

WAITPOINT_INTERPOSED int pthread_sigqueue(pthread_t id, int signal, sigval value) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(pthread_sigqueue)(id, signal, value);
  return send_to_thread(find(id), with_value(signal, value));
}
