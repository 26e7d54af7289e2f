// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/fork_server.hpp"

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
#include "fibers/posix/exec/rerun_control.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

// False if no further packet comes.
bool receive(int socket, int (&descriptors)[run_descriptors]) {
  char byte = 0;
  iovec part{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptors)];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  ssize_t size = 0;
  do size = recvmsg(socket, &message, 0);
  while (size < 0 && errno == EINTR);
  const cmsghdr* const head = size > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
  if (head == nullptr || head->cmsg_len != CMSG_LEN(sizeof descriptors)) return false;
  std::memcpy(descriptors, CMSG_DATA(head), sizeof descriptors);
  return true;
}

template <class T>
void answer(int socket, const T& what) {
  static_assert(std::is_trivially_copyable_v<T>, "an answer is sent byte by byte");
  (void)send(socket, &what, sizeof what, MSG_NOSIGNAL);
}

// In the run: it has the same descriptors as a program that was just started.
void become_run(int socket, const int (&descriptors)[run_descriptors]) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);
  close(socket);
  dup2(descriptors[run_input], STDIN_FILENO);
  dup2(descriptors[run_output], STDOUT_FILENO);
  dup2(descriptors[run_output], STDERR_FILENO);
  for (const int one : descriptors) close(one);
}

// Waits for the end of the run's first process, and returns its status. It remains a zombie, so that its number is its
// group's. All are killed if nobody waits for the answer any more.
int await_end(pid_t run, int socket) {
  pollfd all[] = {{static_cast<int>(syscall(SYS_pidfd_open, run, 0)), POLLIN, 0}, {socket, 0, 0}};
  while (poll(all, std::size(all), -1) < 0 && errno == EINTR) {
  }
  close(all[0].fd);
  if ((all[1].revents & POLLHUP) != 0)
    for (const pid_t each : {run, -run}) kill(each, SIGKILL);
  siginfo_t end{};
  while (waitid(P_PID, static_cast<id_t>(run), &end, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  if (end.si_code == CLD_EXITED) return W_EXITCODE(end.si_status, 0);
  return end.si_status | (end.si_code == CLD_DUMPED ? WCOREFLAG : 0);
}

// The explorer waits for both kinds of ends in one place.
void tell_of_end() {
  std::atomic<std::uint32_t>& ended = rerun_control().ended;
  ended.store(RerunControl::as_process);
  call_directly(SYS_futex, reinterpret_cast<long>(&ended), FUTEX_WAKE, 1);
}

// Once it is asked for, ends those that the first process has left behind.
void end_others(pid_t run, int socket) {
  char byte = 0;
  while (recv(socket, &byte, 1, 0) < 0 && errno == EINTR) {
  }
  kill(-run, SIGKILL);
  while (waitpid(run, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

void serve_runs(int socket) {
  prctl(PR_SET_PDEATHSIG, 0);  // it ends the run before itself
  setpgid(0, 0);               // a signal to the explorer's group must not end it before the explorer has reported
  answer(socket, ServerReady{});
  int descriptors[run_descriptors];
  while (receive(socket, descriptors)) {
    const pid_t run = fork();
    if (run == 0) return become_run(socket, descriptors);
    for (const int one : descriptors) close(one);
    answer(socket, RunStarted{run});
    if (run < 0) continue;
    answer(socket, RunEnded{await_end(run, socket)});
    tell_of_end();
    end_others(run, socket);
    answer(socket, RunGone{});
  }
  _exit(0);
}

}  // namespace waitpoint::posix
