// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_run.hpp"

#include <fmt/format.h>
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
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr int look_ms = 100;

}  // namespace

std::string over_limit(double limit_s) {
  return fmt::format("exceeded {} s of wall clock time (--schedule-limit)", static_cast<long>(limit_s));
}

int ProgramRun::wait_for_end(pid_t program, const posix::Record& record, EndRequests& requests, double limit_s,
                             const std::function<void()>& look) {
  const int end = static_cast<int>(syscall(SYS_pidfd_open, program, 0));
  const double start_s = wall_clock_s();
  Watchdog watchdog(record);
  for (pollfd one{end, POLLIN, 0}; end >= 0 && poll(&one, 1, look_ms) <= 0 && !requests.look();) {
    if (look) look();
    if (limit_s > 0 && wall_clock_s() - start_s >= limit_s) {
      is_over_limit_ = true;
      end_at_once(record, program, over_limit(limit_s));
      break;
    }
    if (const std::string words = watchdog.look(); !words.empty())
      std::fprintf(stderr, "waitpoint: %s\n", words.c_str());
  }
  int status = 0;
  while (waitpid(program, &status, 0) < 0 && errno == EINTR) {
    if (requests.look()) continue;
  }
  if (end >= 0) close(end);
  return status;
}

ProgramRun::ProgramRun(const ProgramFiles& files, const RunMemory& memory, OutputStreams streams, double limit_s,
                       const std::function<void()>& look) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // processes whose parents have ended are its own
  const pid_t program = start_program(files, memory, streams);
  EndRequests requests(memory.record(), program);
  status_ = wait_for_end(program, memory.record(), requests, limit_s, look);
  end_others(memory.record(), [&] {
    if (look) look();
    return requests.look();
  });
  is_interrupted_ = requests.ended_by() != 0;
  if (is_interrupted_) status_ = requests.ended_by();
}

void end_by(int signal) {
  const rlimit no_second_core{};
  setrlimit(RLIMIT_CORE, &no_second_core);
  std::signal(signal, SIG_DFL);
  raise(signal);
  std::exit(128 + signal);
}

}  // namespace waitpoint::tools
