// SPDX-License-Identifier: BSD-3-Clause
// Loads a program once, and runs it any number of times by forks from just before main().
#pragma once

#include <optional>

#include "tools/exec/program_process.hpp"

namespace waitpoint::tools {

class ForkServer {
 public:
  /// Starts the program and stops it before main(); until then, its output goes to this process's. BadInput if it does
  /// not reach main().
  ForkServer(const ProgramFiles& files, const posix::Settings& settings);
  /// Ends the program, and the run that goes on.
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

  /// The memory of the next run, with these settings. There is one run at a time.
  RunMemory& begin(const posix::Settings& settings);
  /// Starts the run, with descriptors for its input and output; returns its process.
  pid_t start(int input, int output);
  /// Waits for its end, for at most `timeout_ms`; the status is as from waitpid().
  std::optional<int> wait(int timeout_ms);
  /// After its end: kills the processes that it has left behind.
  void end();

 private:
  RunMemory memory_;
  int socket_;
  pid_t process_;
};

}  // namespace waitpoint::tools
