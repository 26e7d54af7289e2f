// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/timers.hpp"

#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

void schedule(Scheduler& scheduler, EventNode& node, Time time, const Object& timer, Phase phase) {
  put(scheduler, node, {time, make_order(phase, Chooser::tie(timer))});
}

void cancel(Scheduler& scheduler, EventNode& node) { scheduler.agenda.events.remove(node); }

}  // namespace waitpoint::kernel
