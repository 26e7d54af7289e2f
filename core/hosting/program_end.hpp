// SPDX-License-Identifier: BSD-3-Clause
// The end of a program: its exit status, or the signal that ended it.
#pragma once

#include <sys/wait.h>

#include <cstring>
#include <string>

namespace waitpoint {

class ProgramEnd {
 public:
  /// The exit status of a program that could not be started, as a shell has it.
  static constexpr int not_started = 127;

  /// `status` is as of waitpid().
  explicit ProgramEnd(int status) : status_(status) {}
  static ProgramEnd by_exit(int exit_status) { return ProgramEnd(W_EXITCODE(exit_status & 0xFF, 0)); }

  /// The signal; 0 if it has exited.
  int signal() const { return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0; }
  /// As a shell reports it: 128 and the signal's number after a signal.
  int exit_status() const { return signal() != 0 ? 128 + signal() : WEXITSTATUS(status_); }
  bool is_failure() const { return exit_status() != 0; }
  /// "ended with status 3", "ended by signal 9 (Killed)".
  std::string in_words() const {
    if (signal() == 0) return "ended with status " + std::to_string(exit_status());
    return "ended by signal " + std::to_string(signal()) + " (" + strsignal(signal()) + ")";
  }

 private:
  int status_;
};

}  // namespace waitpoint
