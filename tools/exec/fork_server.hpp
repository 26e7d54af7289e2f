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
  ForkServer(const ProgramFiles& files, posix::Settings settings);
  /// Kills the remaining runs.
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

 private:
  friend class ServedRun;
  int socket_;
  pid_t process_;
};

/// A run; it may be requested by a fork of the process that owns the server object. Killed with this object.
class ServedRun {
 public:
  /// Runs with the settings in `memory`, with descriptors for its input and output.
  ServedRun(const ForkServer& server, const RunMemory& memory, int input, int output);
  ~ServedRun();
  ServedRun(const ServedRun&) = delete;
  ServedRun& operator=(const ServedRun&) = delete;

  pid_t process() const { return process_; }
  /// Waits for its end, for at most `timeout_ms`; the status is as from waitpid().
  std::optional<int> wait(int timeout_ms);

 private:
  int answers_;
  pid_t process_;
};

}  // namespace waitpoint::tools
