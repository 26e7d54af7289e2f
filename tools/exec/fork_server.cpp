// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/fork_server.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>

#include "core/error.hpp"
#include "fibers/posix/reruns/fork_server.hpp"
#include "fibers/posix/reruns/rerun_control.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/signal_words.hpp"

namespace waitpoint::tools {
namespace {

[[noreturn]] void fail(const char* what) { throw BadInput("exec", std::string(what) + ": " + std::strerror(errno)); }

// True if a complete answer arrived.
template <class Answer>
bool receive(int socket, Answer& answer) {
  ssize_t size = 0;
  do size = recv(socket, &answer, sizeof answer, 0);
  while (size < 0 && errno == EINTR && interruption() == 0);
  return size == static_cast<ssize_t>(sizeof answer);
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return "terminated by " + signal_in_words(WTERMSIG(status));
  return "exit status " + std::to_string(WEXITSTATUS(status));
}

void ask(int socket, const int (&descriptors)[posix::run_descriptors]) {
  char byte = 0;
  iovec part{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptors)] = {};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* const head = CMSG_FIRSTHDR(&message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof descriptors);
  std::memcpy(CMSG_DATA(head), descriptors, sizeof descriptors);
  (void)sendmsg(socket, &message, MSG_NOSIGNAL);  // a missing receiver is noticed when no answer arrives
}

long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* timeout) {
  return syscall(SYS_futex, &word, operation, value, timeout, nullptr, 0);
}

void ask_again(posix::RerunControl& control) {
  control.asked.fetch_add(1);
  futex(control.asked, FUTEX_WAKE, 1, nullptr);
}

bool has_ended(posix::RerunControl& control, int timeout_ms) {
  const timespec patience{timeout_ms / 1000, timeout_ms % 1000 * 1'000'000L};
  if (control.ended.load() == posix::RerunControl::not_yet)
    futex(control.ended, FUTEX_WAIT, posix::RerunControl::not_yet, &patience);
  return control.ended.load() != posix::RerunControl::not_yet;
}

}  // namespace

ForkServer::ForkServer(const ProgramFiles& files, const posix::Settings& settings)
    : memory_(settings), listener_(memory_.rerun_control()) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("cannot create a socket");
  const int of_program = fcntl(ends[1], F_DUPFD, least_descriptor);  // stays open in the program
  if (of_program < 0) fail("cannot duplicate a descriptor");
  memory_.record().settings.server = of_program;
  process_ = start_program(files, memory_);
  close(ends[1]);
  close(of_program);
  socket_ = ends[0];
  if (posix::ServerReady ready; receive(socket_, ready)) return;
  close(socket_);
  if (interruption() != 0) kill(process_, SIGKILL);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  throw BadInput("exec", files.program.string() + " did not reach main(): " + how_it_ended(status));
}

ForkServer::~ForkServer() {
  close(socket_);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

RunMemory* ForkServer::begin_in(const Snapshot& snapshot, const posix::Settings& settings,
                                const SnapshotsAsked& asked) {
  memory_.begin_anew(settings, was_orderly_);
  listener_.ask_for(asked);
  of_run_ = snapshot.socket();
  const char byte = 0;
  (void)send(of_run_, &byte, 1, MSG_NOSIGNAL);
  posix::ServerReady ready;
  return receive(of_run_, ready) ? &memory_ : nullptr;
}

RunMemory& ForkServer::begin(const posix::Settings& settings, const SnapshotsAsked& asked) {
  of_run_ = socket_;
  memory_.begin_anew(settings, was_orderly_);
  listener_.ask_for(asked);
  memory_.record().settings.makes_reruns = settings.makes_reruns && gain_.is_worth_preparing();
  return memory_;
}

pid_t ForkServer::start(int input, int output) {
  posix::RerunControl& control = memory_.rerun_control();
  control.ended.store(posix::RerunControl::not_yet);
  if (waiting_ != 0) {
    waiting_ = 0;
    ask_again(control);
    return run_;
  }
  ask(of_run_, {input, output});
  posix::RunStarted started{};
  if (!receive(of_run_, started)) throw BadInput("exec", "the program has ended");
  if (started.process < 0) throw BadInput("exec", "cannot create a process");
  return run_ = started.process;
}

std::optional<int> ForkServer::wait(int timeout_ms) {
  posix::RerunControl& control = memory_.rerun_control();
  if (!has_ended(control, timeout_ms)) {
    pollfd one{of_run_, 0, 0};
    if (poll(&one, 1, 0) <= 0) return std::nullopt;
    return SIGKILL;  // the server is gone
  }
  if (control.ended.load() == posix::RerunControl::in_place) {
    waiting_ = run_;
    was_orderly_ = true;
    gain_.note_kept();
    return control.status;
  }
  posix::RunEnded ended{SIGKILL};
  (void)receive(of_run_, ended);
  was_orderly_ = WIFEXITED(ended.status);
  if (memory_.record().settings.makes_reruns) gain_.note_lost();
  return ended.status;
}

void ForkServer::fork_next() {
  if (waiting_ == 0) return;
  gain_.note_lost();
  posix::RerunControl& control = memory_.rerun_control();
  control.ended.store(posix::RerunControl::not_yet);
  control.is_to_leave = true;
  ask_again(control);
  posix::RunEnded ended;
  (void)receive(socket_, ended);
  waiting_ = 0;
  control.is_to_leave = false;
  end();
}

void ForkServer::end() {
  if (waiting_ != 0) return;
  const char byte = 0;
  (void)send(of_run_, &byte, 1, MSG_NOSIGNAL);
  posix::RunGone gone;
  (void)receive(of_run_, gone);
}

}  // namespace waitpoint::tools
