// SPDX-License-Identifier: BSD-3-Clause
// A run of a program from start to end.
#pragma once

#include <functional>

#include "core/hosting/program_end.hpp"
#include "tools/exec/program_process.hpp"

namespace waitpoint::tools {

class EndRequests;

class ProgramRun {
 public:
  /// Runs the program to its end, with the settings in `memory`, or until `limit_s` seconds of the wall clock have
  /// passed, unless 0. `look` is called about ten times a second meanwhile.
  ProgramRun(const ProgramFiles& files, const RunMemory& memory, OutputStreams streams = {}, double limit_s = 0,
             const std::function<void()>& look = nullptr);

  /// As from waitpid().
  int status() const { return status_; }
  ProgramEnd end() const { return ProgramEnd(status_); }
  /// True if it was ended by a signal to this process: see end_requests.hpp.
  bool is_interrupted() const { return is_interrupted_; }
  /// True if it was ended at the limit.
  bool is_over_limit() const { return is_over_limit_; }

 private:
  /// Returns the status.
  int wait_for_end(pid_t program, const posix::Record& record, EndRequests& requests, double limit_s,
                   const std::function<void()>& look);

  int status_ = 0;
  bool is_interrupted_ = false, is_over_limit_ = false;
};

/// "exceeded 60 s of wall clock time (--schedule-limit)".
std::string over_limit(double limit_s);

/// Ends this process by the signal, so that a shell sees the program's own end.
[[noreturn]] void end_by(int signal);

}  // namespace waitpoint::tools
