// SPDX-License-Identifier: BSD-3-Clause
// A run whose process is to end by its return alone.
//
// While the object exists, exit() in any thread and outside of tasks is reported as the run's death
// (fault_reports.hpp), and so are signals whose usual effect is the process's end: those that another process sends,
// such as a CI that loses patience, those of limits of time, and SIGKILL where the process sends it to itself.
#pragma once

#include <sys/types.h>

#include <bitset>
#include <csignal>

namespace waitpoint::kernel {

class UnfinishedRun {
 public:
  /// Reports outside of tasks show this replay line, which must outlive the object; those of tasks have their
  /// scheduler's. Not two at a time. A signal's handler stays if the caller has one.
  explicit UnfinishedRun(const char* replay_line);
  /// Restores the default effect of the signals.
  ~UnfinishedRun();
  UnfinishedRun(const UnfinishedRun&) = delete;
  UnfinishedRun& operator=(const UnfinishedRun&) = delete;

 private:
  std::bitset<_NSIG> is_handled_;
};

/// True for a signal whose usual effect is the end of the process; not for faults (fault_reports.hpp).
bool ends_process(int signal);
/// The action that reports such a signal as a death.
struct sigaction death_report();

/// To be called before this process sends a signal to `process`, in the words of kill(): reports SIGKILL to itself,
/// which no handler sees, as the death of an unfinished run.
void note_signal_to(pid_t process, int signal);

}  // namespace waitpoint::kernel
