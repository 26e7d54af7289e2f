// SPDX-License-Identifier: BSD-3-Clause
// Loads a program once, and runs it any number of times from just before main(): by forks, and in a forked process that
// can be put back to that state after its run (fibers/posix/exec/rerun.hpp).
#pragma once

#include <optional>

#include "tools/exec/program_process.hpp"
#include "tools/exec/rerun_gain.hpp"

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
  /// Starts the run; returns its process. Its input and output are these descriptors, in a process of the last run's
  /// the ones that it has.
  pid_t start(int input, int output);
  /// True if the next run is made in the process of the last one.
  bool is_rerun() const { return waiting_ != 0; }
  /// True if the process of the last run was to make further ones.
  bool is_followed() const { return memory_.record().settings.makes_reruns; }
  /// Ends that process: the next run is made by a fork.
  void fork_next();
  /// Waits for its end, for at most `timeout_ms`; the status is as from waitpid().
  std::optional<int> wait(int timeout_ms);
  /// After its end: kills the processes that it has left behind.
  void end();

 private:
  RunMemory memory_;
  int socket_;
  pid_t process_;
  pid_t run_ = 0;      ///< the process of the present or last run
  pid_t waiting_ = 0;  ///< the same, if it can make the next run
  bool was_orderly_ = false;
  RerunGain gain_;
};

}  // namespace waitpoint::tools
