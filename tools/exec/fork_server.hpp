// SPDX-License-Identifier: BSD-3-Clause
// Loads a program once, and runs it any number of times from just before main(): by forks, and in a forked process that
// can be put back to that state after its run (fibers/posix/reruns/rerun.hpp); and from snapshots, which runs have
// made.
#pragma once

#include <optional>
#include <vector>

#include "tools/exec/program_process.hpp"
#include "tools/exec/rerun_gain.hpp"
#include "tools/exec/snapshots.hpp"

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
  RunMemory& begin(const posix::Settings& settings, const SnapshotsAsked& asked = {});
  /// The same, for a run that begins in a snapshot; null if that has ended.
  RunMemory* begin_in(const Snapshot& snapshot, const posix::Settings& settings, const SnapshotsAsked& asked);
  /// Starts the run; returns its process. Its input and output are these descriptors, in a process of the last run's
  /// the ones that it has.
  pid_t start(int input, int output);
  /// True if the next run is made in the process of the last one.
  bool is_rerun() const { return waiting_ != 0; }
  /// True if the system calls of the last run were followed, as it was to make further ones, or snapshots.
  bool is_followed() const { return memory_.record().settings.makes_reruns || memory_.rerun_control().room > 0; }
  /// Ends that process: the next run is made by a fork.
  void fork_next();
  /// Waits for its end, for at most `timeout_ms`; the status is as from waitpid().
  std::optional<int> wait(int timeout_ms);
  /// After its end: kills the processes that it has left behind.
  void end();
  /// The snapshots that it has made.
  std::vector<Snapshot> take_snapshots() { return listener_.take(); }

 private:
  RunMemory memory_;
  SnapshotListener listener_;
  int socket_;
  int of_run_ = -1;  ///< the same, or the snapshot's in which the present run began
  pid_t process_;
  pid_t run_ = 0;      ///< the process of the present or last run
  pid_t waiting_ = 0;  ///< the same, if it can make the next run
  bool was_orderly_ = false;
  RerunGain gain_;
};

}  // namespace waitpoint::tools
