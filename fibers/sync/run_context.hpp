// SPDX-License-Identifier: BSD-3-Clause
// The interface of a run for the tasks within it; Simulation implements it.
#pragma once

#include <chrono>
#include <exception>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::sync {

class RunContext {
 public:
  /// The context of the run that `scheduler` executes.
  static RunContext& of(const kernel::Scheduler& scheduler) {
    return *static_cast<RunContext*>(kernel::hooks(scheduler).client);
  }

  /// From within a task: ends the run with an exception. `how` and the task's name begin the run's report.
  virtual void fail(std::exception_ptr failure, const char* how = "an exception escaped from") = 0;
  /// The date of system_clock at virtual time 0.
  virtual std::chrono::sys_time<std::chrono::nanoseconds> start_date() const = 0;
  /// The number of processors reported to threads.
  virtual unsigned hardware_concurrency() const = 0;

 protected:
  ~RunContext() = default;
};

}  // namespace waitpoint::sync
