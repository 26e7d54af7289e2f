// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/fork_server.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/error.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

struct Run {
  pid_t process;
  int end;      // pidfd: ready when the process has ended
  int answers;  // a socket
};

constexpr int runs_max = 1024;
Run runs[runs_max];
int run_count = 0;

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
int become_run(int socket, const int (&descriptors)[run_descriptors]) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);
  for (int i = 0; i < run_count; ++i) {
    close(runs[i].end);
    close(runs[i].answers);
  }
  close(socket);
  dup2(descriptors[run_input], STDIN_FILENO);
  dup2(descriptors[run_output], STDOUT_FILENO);
  dup2(descriptors[run_output], STDERR_FILENO);
  for (const int one : {run_input, run_output, run_answers}) close(descriptors[one]);
  return descriptors[run_record];
}

void reap(int index) {
  WAITPOINT_CHECK(index >= 0 && index < run_count && runs[index].process > 0, "a run ends that is not in the table");
  const Run run = runs[index];
  runs[index] = runs[--run_count];
  kill(-run.process, SIGKILL);  // with the processes that it has started
  int status = 0;
  while (waitpid(run.process, &status, 0) < 0 && errno == EINTR) {
  }
  answer(run.answers, RunEnded{status});
  close(run.end);
  close(run.answers);
}

// Handles the ends of runs until a packet comes; false without further packets.
bool wait_for_packet(int socket) {
  static pollfd all[2 * runs_max + 1];
  for (;;) {
    all[0] = {socket, POLLIN, 0};
    for (int i = 0; i < run_count; ++i) {
      all[2 * i + 1] = {runs[i].end, POLLIN, 0};
      all[2 * i + 2] = {runs[i].answers, 0, 0};
    }
    const int count = run_count;
    if (poll(all, static_cast<nfds_t>(2 * count + 1), -1) < 0 && errno != EINTR) return false;
    for (int i = count; i-- > 0;) {
      if ((all[2 * i + 2].revents & POLLHUP) != 0) kill(runs[i].process, SIGKILL);
      if (all[2 * i + 1].revents != 0) reap(i);
    }
    if (all[0].revents != 0 && run_count < runs_max) return true;
  }
}

}  // namespace

int serve_runs(int socket) {
  answer(socket, ServerReady{});
  int descriptors[run_descriptors];
  while (wait_for_packet(socket) && receive(socket, descriptors)) {
    const pid_t process = fork();
    if (process == 0) return become_run(socket, descriptors);
    for (const int one : {run_record, run_input, run_output}) close(descriptors[one]);
    answer(descriptors[run_answers], RunStarted{process});
    if (process < 0) {
      close(descriptors[run_answers]);
      continue;
    }
    WAITPOINT_CHECK(run_count < runs_max, "the table of runs has no room for another");
    runs[run_count++] = {process, static_cast<int>(syscall(SYS_pidfd_open, process, 0)), descriptors[run_answers]};
  }
  _exit(0);
}

}  // namespace waitpoint::posix
