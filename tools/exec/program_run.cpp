// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_run.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "tools/exec/family_report.hpp"
#include "tools/exec/watchdog.hpp"

namespace waitpoint::tools {
namespace {

constexpr int looks_ms = 1000;

pid_t child = 0;
void pass_on(int signal) { kill(child, signal); }
// Signals of the terminal reach the program anyway; only those sent by another process must be forwarded.
void pass_on_if_sent(int signal, siginfo_t* information, void*) {
  if (information->si_code <= 0) kill(child, signal);
}

/// Leaves the decision about signals to the program.
int wait_for_end(Watchdog watchdog) {
  struct sigaction of_terminal {};
  of_terminal.sa_sigaction = pass_on_if_sent;
  of_terminal.sa_flags = SA_SIGINFO | SA_RESTART;
  for (const int signal : {SIGINT, SIGQUIT}) sigaction(signal, &of_terminal, nullptr);
  for (const int signal : {SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) std::signal(signal, pass_on);
  int status = 0;
  const int end = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  for (pollfd one{end, POLLIN, 0}; end >= 0 && poll(&one, 1, looks_ms) <= 0;)
    if (const std::string words = watchdog.look(); !words.empty())
      std::fprintf(stderr, "waitpoint: %s\n", words.c_str());
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (end >= 0) close(end);
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) std::signal(signal, SIG_DFL);
  return status;
}

}  // namespace

ProgramRun::ProgramRun(const ProgramFiles& files, const RunMemory& memory, int output) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // processes whose parents have ended are its own
  child = start_program(files, memory, output);
  status_ = wait_for_end(Watchdog(memory.record(), child));
  end_others(memory.record());
}

int ProgramRun::exit_status() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }
int ProgramRun::signal() const { return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0; }

void end_by(int signal) {
  const rlimit no_second_core{};
  setrlimit(RLIMIT_CORE, &no_second_core);
  std::signal(signal, SIG_DFL);
  raise(signal);
  std::exit(128 + signal);
}

}  // namespace waitpoint::tools
