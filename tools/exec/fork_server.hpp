// SPDX-License-Identifier: BSD-3-Clause
// A program that is loaded once, and run as often as one likes by fork, from where it is about to enter its main().
#pragma once

#include <optional>

#include "tools/exec/program_process.hpp"

namespace waitpoint::tools {

class ForkServer {
 public:
  /// Starts the program and lets it stand there; what it writes before goes where this process writes. BadInput if it
  /// does not come as far.
  ForkServer(const ProgramFiles& files, posix::Settings settings);
  /// Runs that are left are ended.
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

 private:
  friend class ServedRun;
  int socket_;
  pid_t process_;
};

/// A run; it may be asked for in a process that was forked from that of the server's object. It is ended with it.
class ServedRun {
 public:
  /// As `memory` says, with descriptors that its input comes from and its output goes to.
  ServedRun(const ForkServer& server, const RunMemory& memory, int input, int output);
  ~ServedRun();
  ServedRun(const ServedRun&) = delete;
  ServedRun& operator=(const ServedRun&) = delete;

  pid_t process() const { return process_; }
  /// Waits for its end, `timeout_ms` at most: as waitpid() gives it.
  std::optional<int> wait(int timeout_ms);

 private:
  int answers_;
  pid_t process_;
};

}  // namespace waitpoint::tools
