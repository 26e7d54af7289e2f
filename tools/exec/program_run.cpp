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

#include "tools/exec/end_requests.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/watchdog.hpp"

namespace waitpoint::tools {
namespace {

constexpr int look_ms = 100;

// The status as of waitpid().
int wait_for_end(pid_t program, Watchdog watchdog, EndRequests& requests) {
  const int end = static_cast<int>(syscall(SYS_pidfd_open, program, 0));
  for (pollfd one{end, POLLIN, 0}; end >= 0 && poll(&one, 1, look_ms) <= 0 && !requests.look();)
    if (const std::string words = watchdog.look(); !words.empty())
      std::fprintf(stderr, "waitpoint: %s\n", words.c_str());
  int status = 0;
  while (waitpid(program, &status, 0) < 0 && errno == EINTR) {
    if (requests.look()) continue;
  }
  if (end >= 0) close(end);
  return status;
}

}  // namespace

ProgramRun::ProgramRun(const ProgramFiles& files, const RunMemory& memory, int output) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // processes whose parents have ended are its own
  const pid_t program = start_program(files, memory, output);
  EndRequests requests(memory.record(), program);
  status_ = wait_for_end(program, Watchdog(memory.record()), requests);
  end_others(memory.record(), [&] { return requests.look(); });
  is_interrupted_ = requests.ended_by() != 0;
  if (is_interrupted_) status_ = requests.ended_by();
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
