// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reruns/fork_server.hpp"

#include <linux/futex.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reruns/rerun_control.hpp"

namespace waitpoint::posix {
namespace {

// All calls are direct ones: in a snapshot the program's functions are simulated.

template <class T>
long to_word(T value) {
  if constexpr (std::is_pointer_v<T>)
    return reinterpret_cast<long>(value);
  else
    return static_cast<long>(value);
}

template <class... Words>
long call(long number, Words... words) {
  long result = 0;
  do result = call_directly(number, to_word(words)...);
  while (result == -EINTR);
  return result;
}

// The number of bytes; 0 if no further packet comes. Without a byte of control data no descriptors are received.
long receive(int socket, void* control, std::size_t size_of_control) {
  char byte = 0;
  iovec part{&byte, 1};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = size_of_control;
  const long size = call(SYS_recvmsg, socket, &message, 0);
  const cmsghdr* const head = size > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
  const bool is_as_asked = (head == nullptr) == (control == nullptr);
  return is_as_asked && (head == nullptr || head->cmsg_len <= size_of_control) ? size : 0;
}

// False if no further packet comes.
bool receive(int socket, int (&descriptors)[run_descriptors]) {
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptors)];
  if (receive(socket, control, sizeof control) <= 0) return false;
  const cmsghdr* const head = reinterpret_cast<const cmsghdr*>(control);
  if (head->cmsg_len != CMSG_LEN(sizeof descriptors)) return false;
  std::memcpy(descriptors, CMSG_DATA(head), sizeof descriptors);
  return true;
}

template <class T>
void answer(int socket, const T& what) {
  static_assert(std::is_trivially_copyable_v<T>, "an answer is sent byte by byte");
  call(SYS_sendto, socket, &what, sizeof what, MSG_NOSIGNAL, 0, 0);
}

// In the run: it has the same descriptors as a program that was just started.
void become_run(int socket, const int (&descriptors)[run_descriptors]) {
  call(SYS_prctl, PR_SET_PDEATHSIG, SIGKILL);
  call(SYS_setpgid, 0, 0);
  call(SYS_close, socket);
  call(SYS_dup2, descriptors[run_input], STDIN_FILENO);
  call(SYS_dup2, descriptors[run_output], STDOUT_FILENO);
  call(SYS_dup2, descriptors[run_output], STDERR_FILENO);
  for (const int one : descriptors) call(SYS_close, one);
}

// Waits for the end of the run's first process, and returns its status. It remains a zombie, so that its number is its
// group's. All are killed if nobody waits for the answer any more.
int await_end(pid_t run, int socket) {
  pollfd all[] = {{static_cast<int>(call(SYS_pidfd_open, run, 0)), POLLIN, 0}, {socket, 0, 0}};
  call(SYS_poll, &all, std::size(all), -1);
  call(SYS_close, all[0].fd);
  if ((all[1].revents & POLLHUP) != 0)
    for (const pid_t each : {run, -run}) call(SYS_kill, each, SIGKILL);
  siginfo_t end{};
  call(SYS_waitid, P_PID, run, &end, WEXITED | WNOWAIT, 0);
  if (end.si_code == CLD_EXITED) return W_EXITCODE(end.si_status, 0);
  return end.si_status | (end.si_code == CLD_DUMPED ? WCOREFLAG : 0);
}

// The explorer waits for both kinds of ends in one place.
void tell_of_end() {
  std::atomic<std::uint32_t>& ended = rerun_control().ended;
  ended.store(RerunControl::as_process);
  call(SYS_futex, &ended, FUTEX_WAKE, 1);
}

// Once it is asked for, ends those that the first process has left behind, and forgets the snapshots that have ended.
void end_others(pid_t run, int socket) {
  char byte = 0;
  call(SYS_recvfrom, socket, &byte, 1, 0, 0, 0);
  call(SYS_kill, -run, SIGKILL);
  call(SYS_wait4, run, 0, 0, 0);
  while (call(SYS_wait4, -1, 0, WNOHANG, 0) > 0) {
  }
}

// Returns in each run.
void serve(int socket, void (*prepare)(), pid_t (*make)()) {
  call(SYS_prctl, PR_SET_PDEATHSIG, 0);  // it ends the run before itself
  call(SYS_setpgid, 0, 0);  // a signal to the explorer's group must not end it before the explorer has reported
  answer(socket, ServerReady{});
  for (int descriptors[run_descriptors];;) {
    if (prepare != nullptr) {
      if (receive(socket, nullptr, 0) <= 0) break;
      prepare();
      answer(socket, ServerReady{});
    }
    if (!receive(socket, descriptors)) break;
    const pid_t run = make();
    if (run == 0) return become_run(socket, descriptors);
    for (const int one : descriptors) call(SYS_close, one);
    answer(socket, RunStarted{run});
    if (run < 0) continue;
    answer(socket, RunEnded{await_end(run, socket)});
    tell_of_end();
    end_others(run, socket);
    answer(socket, RunGone{});
  }
  call(SYS_exit_group, 0);
}

}  // namespace

void serve_runs(int socket) {
  serve(socket, nullptr, [] { return fork(); });
}

// The C library's state stays as it is, as does the program's.
void serve_runs_of_snapshot(int socket, void (*prepare)()) {
  serve(socket, prepare, [] { return static_cast<pid_t>(call_directly(SYS_clone, SIGCHLD)); });
}

}  // namespace waitpoint::posix
