// SPDX-License-Identifier: BSD-3-Clause
// A run of a program from its beginning to its end, and who waits for it meanwhile.
#pragma once

#include "tools/exec/program_process.hpp"

namespace waitpoint::tools {

class ProgramRun {
 public:
  /// Runs the program to its end, as `memory` says. What it writes goes where this process writes, or to the descriptor
  /// `output`, if there is one.
  ProgramRun(const ProgramFiles& files, const RunMemory& memory, int output = -1);

  /// As waitpid() gives it.
  int status() const { return status_; }
  /// The exit status; -1 where a signal ended it.
  int exit_status() const;
  /// The signal that ended it; 0 if none did.
  int signal() const;

 private:
  int status_ = 0;
};

/// Ends this process by the signal, as a shell sees the program itself.
[[noreturn]] void end_by(int signal);

}  // namespace waitpoint::tools
