// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/check.hpp"

#include <stdexcept>
#include <string>

#include "fibers/kernel/interruption.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/simulation.hpp"

namespace waitpoint {

void check(bool holds, const char* message, const char* file, int line) {
  if (holds) return;
  kernel::Scheduler& scheduler = *sync::running_task().scheduler;
  if (kernel::is_unwinding(scheduler)) return;
  const std::string text = std::string(file) + ":" + std::to_string(line) + ": " + message;
  Simulation::of(scheduler).fail(std::make_exception_ptr(std::runtime_error(text)), "a check failed in");
  sync::unwind();
}

}  // namespace waitpoint
