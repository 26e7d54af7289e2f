// SPDX-License-Identifier: BSD-3-Clause
// A run whose process is to end by its return alone.
//
// While the object exists, exit() in any thread and outside of tasks is reported as the run's death
// (fault_reports.hpp), and so are signals whose usual effect is the process's end: those that another process sends,
// such as a CI that loses patience, and those of limits of time.
#pragma once

#include <csignal>
#include <cstddef>
#include <iterator>

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

  /// SIGINT, SIGTERM and SIGHUP interrupt a run in good order instead.
  static constexpr int signals[] = {SIGQUIT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM, SIGPROF};

 private:
  static void handle(int signal, siginfo_t* info, void* context);

  bool has_handler_[std::size(signals)]{};
};

}  // namespace waitpoint::kernel
