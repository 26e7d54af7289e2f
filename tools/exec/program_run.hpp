// SPDX-License-Identifier: BSD-3-Clause
// A run of a program from start to end.
#pragma once

#include "tools/exec/program_process.hpp"

namespace waitpoint::tools {

class ProgramRun {
 public:
  /// Runs the program to its end, with the settings in `memory`. Its output goes to this process's, or to the
  /// descriptor `output`.
  ProgramRun(const ProgramFiles& files, const RunMemory& memory, int output = -1);

  /// As from waitpid().
  int status() const { return status_; }
  /// The exit status; -1 if a signal ended it.
  int exit_status() const;
  /// The signal that ended it; 0 if none.
  int signal() const;
  /// True if it was ended by a signal to this process: see end_requests.hpp.
  bool is_interrupted() const { return is_interrupted_; }

 private:
  int status_ = 0;
  bool is_interrupted_ = false;
};

/// Ends this process by the signal, so that a shell sees the program's own end.
[[noreturn]] void end_by(int signal);

}  // namespace waitpoint::tools
