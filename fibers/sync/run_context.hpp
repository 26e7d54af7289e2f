// SPDX-License-Identifier: BSD-3-Clause
// The run as a task within it sees it. The simulation is one.
#pragma once

#include <chrono>
#include <exception>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::sync {

class RunContext {
 public:
  /// Of the run that `scheduler` executes.
  static RunContext& of(const kernel::Scheduler& scheduler) { return *static_cast<RunContext*>(scheduler.hooks().client); }

  /// From within a task: ends the run with an exception. `how` and the task's name begin what the run's report says.
  virtual void fail(std::exception_ptr failure, const char* how = "an exception escaped from") = 0;
  /// What system_clock shows at virtual time 0.
  virtual std::chrono::sys_time<std::chrono::nanoseconds> start_date() const = 0;
  /// What threads are told of the machine's processors.
  virtual unsigned hardware_concurrency() const = 0;

 protected:
  ~RunContext() = default;
};

}  // namespace waitpoint::sync
