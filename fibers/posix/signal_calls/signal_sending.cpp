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
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/process_descriptors.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

// Signals to this thread are handled before the call returns.
void handle_own() {
  kernel::Task& task = *kernel::running;
  if ((task.attention & kernel::attention::signal) == 0) return;
  kernel::attend(task, kernel::attention::signal, false);
  handle_signals();
}

int send_here(const siginfo_t& information, Thread* to) {
  WAITPOINT_CHECK(to == nullptr || to->program == &this_program(),
                  "a signal is sent to another program as to this one");
  WAITPOINT_CHECK(is_signal(information.si_signo), "a number is sent that is no signal");
  WAITPOINT_CHECK(to == nullptr || to->task != nullptr, "a signal is sent to a thread that has ended");
  if (contains(only(SIGKILL) | only(SIGSTOP), information.si_signo)) {
    do_default(information.si_signo);
    return 0;
  }
  if (!send(information, this_program(), to)) return EAGAIN;
  handle_own();
  return 0;
}

bool is_number(int signal) { return signal == 0 || is_signal(signal); }

// Returns an error number.
int send_to_thread(Thread* thread, siginfo_t information) {
  if (thread == nullptr || thread->program != &this_program()) return ESRCH;
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

// True if it names the process in which this program is one of several: the program is meant, and no other.
bool is_process_of_several(pid_t process) {
  return has_host && is_simulated() && (process == getpid() || process == 0 || process == -getpgrp());
}

int send_to_program(siginfo_t information) {
  if (!is_number(information.si_signo)) return EINVAL;
  pass(kernel::Operation::signal, nullptr);
  return information.si_signo == 0 ? 0 : send_here(information, nullptr);
}

int result_of(int error) { return error == 0 ? 0 : fail(error); }

// To another process of the family. Returns an error number.
int send_to_other(family::Process& process, const siginfo_t& information) {
  using State = family::Process::State;
  const int signal = information.si_signo;
  if (signal == 0 || process.state == State::ended) return 0;
  if (process.is_native) return WAITPOINT_NEXT(kill)(process.real_id, signal) == 0 ? 0 : errno;
  if (signal == SIGKILL) {
    family::kill_at_once(process);
    look_at_descriptors(family::of_anything);
    return 0;
  }
  if (signal == SIGSTOP) family::note_stop_of(process, signal);
  if (signal == SIGCONT) family::note_continuation_of(process);
  if (signal == SIGSTOP) return 0;
  return family::send_letter(process, information, 0) ? 0 : EAGAIN;
}

// As kill(). Returns an error number.
int send_to_processes(pid_t to, const siginfo_t& information) {
  bool any = false, own = false;
  const pid_t group = to == 0 ? family::own->group : -to;
  for (family::Process& process : family::entries()) {
    if (process.state == family::Process::State::none) continue;
    const bool is_meant = to > 0 ? process.id == to : to == -1 ? &process != family::own : process.group == group;
    if (!is_meant) continue;
    any = true;
    if (&process == family::own)
      own = true;
    else if (const int error = send_to_other(process, information); error != 0)
      return error;
  }
  if (own && information.si_signo != 0) return send_here(information, nullptr);
  return any ? 0 : ESRCH;
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
  if (is_process_of_several(process)) return result_of(send_to_program(from_here(signal, SI_USER)));
  if (!is_simulated() || family::own == nullptr) return WAITPOINT_NEXT(kill)(process, signal);
  if (!is_number(signal)) return fail(EINVAL);
  pass(kernel::Operation::signal, nullptr);
  const int error = send_to_processes(process, from_here(signal, SI_USER));
  return result_of(error);
}

WAITPOINT_INTERPOSED int killpg(pid_t group, int signal) noexcept {
  return group < 0 ? fail(EINVAL) : kill(-group, signal);
}

WAITPOINT_INTERPOSED int raise(int signal) noexcept {
  if (!is_simulated() || !is_signal(signal)) return WAITPOINT_NEXT(raise)(signal);
  const int error = send_to_thread(&this_thread(), from_here(signal, SI_TKILL));
  return result_of(error);
}

WAITPOINT_INTERPOSED int tgkill(pid_t process, pid_t thread, int signal) {
  if (is_process_of_several(process))
    return result_of(send_to_thread(thread_with_id(thread), from_here(signal, SI_TKILL)));
  if (!is_simulated() || family::own == nullptr) return WAITPOINT_NEXT(tgkill)(process, thread, signal);
  if (thread <= 0 || process <= 0) return fail(EINVAL);
  if (process != getpid()) {
    family::Process* const to = family::find(process);
    if (to == nullptr) return fail(ESRCH);
    if (signal != 0 && !family::send_letter(*to, from_here(signal, SI_TKILL), thread)) return fail(EAGAIN);
    return 0;
  }
  const int error = send_to_thread(thread_with_id(thread), from_here(signal, SI_TKILL));
  return result_of(error);
}

WAITPOINT_INTERPOSED int sigqueue(pid_t process, int signal, sigval value) noexcept {
  if (is_process_of_several(process)) return result_of(send_to_program(with_value(signal, value)));
  if (!is_simulated() || family::own == nullptr) return WAITPOINT_NEXT(sigqueue)(process, signal, value);
  if (!is_number(signal)) return fail(EINVAL);
  if (process == getpid()) {
    const int error = send_as_told(with_value(signal, value));
    return result_of(error);
  }
  pass(kernel::Operation::signal, nullptr);
  const int error = process > 0 ? send_to_processes(process, with_value(signal, value)) : ESRCH;
  return result_of(error);
}

WAITPOINT_INTERPOSED int pidfd_send_signal(int process, int signal, siginfo_t* information, unsigned flags) noexcept {
  const bool is_told = information == nullptr || (can_be_read(information) && information->si_signo == signal);
  family::Process* const to = is_simulated() ? family::find(process_of(process)) : nullptr;
  if (to == nullptr || flags != 0 || !is_told)
    return WAITPOINT_NEXT(pidfd_send_signal)(process, signal, information, flags);
  siginfo_t sent = information != nullptr ? *information : from_here(signal, SI_USER);
  sent.si_signo = signal;
  const int error = to == family::own ? send_as_told(sent) : send_to_processes(to->id, sent);
  return result_of(error);
}

WAITPOINT_INTERPOSED int pthread_kill(pthread_t id, int signal) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(pthread_kill)(id, signal);
  return send_to_thread(find(id), from_here(signal, SI_TKILL));
}

WAITPOINT_INTERPOSED int pthread_sigqueue(pthread_t id, int signal, sigval value) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(pthread_sigqueue)(id, signal, value);
  return send_to_thread(find(id), with_value(signal, value));
}
