// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/program_clock.hpp"

namespace waitpoint::posix {
namespace {

void begin_segment(kernel::LocalClock& clock, kernel::Task&) { static_cast<kernel::TaskClock&>(clock).runs = true; }

void end_segment(kernel::LocalClock& clock, kernel::Task& task) {
  auto& self = static_cast<kernel::TaskClock&>(clock);
  if (!self.runs) return;
  self.runs = false;
  self.compute(self, task, self.options.least, self.options.greatest);
}

}  // namespace

ProgramClock::ProgramClock(const kernel::ClockOptions& options) : clock_(options) {
  if (options.kind != kernel::ClockKind::fixed && options.kind != kernel::ClockKind::interval) return;
  clock_.begin = begin_segment;
  clock_.end = end_segment;
}

}  // namespace waitpoint::posix
