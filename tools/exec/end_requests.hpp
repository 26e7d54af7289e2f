// SPDX-License-Identifier: BSD-3-Clause
// Signals that ask `waitpoint exec` to end: SIGINT, SIGTERM, SIGHUP. The run ends at once, with a report of what its
// threads do, unless the program handles the signal: then it gets it. A program that handles SIGINT or SIGTERM and has
// not ended two seconds later is ended in the same way, as it is by a second signal; one that handles SIGHUP or the
// terminal's SIGINT decides for itself.
#pragma once

#include <sys/types.h>

#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// Ends the run of `program`, and reports the activities of its threads: "waitpoint: REASON at 3.000000000 s of virtual
/// time".
void end_at_once(const posix::Record& record, pid_t program, const std::string& reason);

class EndRequests {
 public:
  /// From now on signals to this process are for the run of `program`; SIGQUIT, SIGUSR1 and SIGUSR2 are passed on.
  EndRequests(const posix::Record& record, pid_t program);
  /// All have their default action again.
  ~EndRequests();
  EndRequests(const EndRequests&) = delete;
  EndRequests& operator=(const EndRequests&) = delete;

  /// Call at intervals, and after each signal. True once the run was ended by a signal.
  bool look();
  /// The signal that ended the run; 0: none did.
  int ended_by() const { return ended_by_; }

  /// A signal that came when the last run had ended already, and is for those that follow; 0: none. Forgets it.
  static int too_late();

 private:
  void end(int signal);

  const posix::Record& record_;
  pid_t program_;
  int asked_by_ = 0;       ///< the first signal that was passed on
  double asked_at_s_ = 0;  ///< by the wall clock
  int ended_by_ = 0;
};

}  // namespace waitpoint::tools
