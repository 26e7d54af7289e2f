// SPDX-License-Identifier: BSD-3-Clause
// Events that are not a task's: EventNode::fire is called when they are due, in the main fiber or that of the task that
// looks for the next event. It must not block.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/event.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct EventNode;
struct Object;

/// Inserts a timer's event, by default ahead of the tasks of that instant. `timer` must have entered the run.
void schedule(Scheduler& scheduler, EventNode& node, Time time, const Object& timer, Phase phase = Phase::deliveries);
void cancel(Scheduler& scheduler, EventNode& node);

}  // namespace waitpoint::kernel
