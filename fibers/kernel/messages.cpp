// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/messages.hpp"

#include "core/error.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

void deliver(Scheduler& scheduler, EventNode& node, Time time, Robot& sender) {
  deliver(scheduler, node, time, sender, ++sender.messages);
}

void deliver(Scheduler& scheduler, EventNode& node, Time time, const Robot& sender, std::uint64_t count) {
  put(scheduler, node, {time, make_order(Phase::deliveries, Chooser::tie(sender, count))});
}

void declare_latency(Scheduler& scheduler, Duration least) {
  WAITPOINT_REQUIRE(least > Duration(), "a link between robots has no latency");
  if (least < scheduler.least_latency) scheduler.least_latency = least;
}

Duration lookahead(const Scheduler& scheduler) { return scheduler.least_latency; }

}  // namespace waitpoint::kernel
