// SPDX-License-Identifier: BSD-3-Clause
// A run as the layers above see it: its settings, its robots and tasks, and what it has counted. They run it by
// windows (run_window.hpp); their tasks use it by waitpoints (waitpoint_calls.hpp, waiting_calls.hpp).
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/chooser.hpp"
#include "fibers/kernel/hooks.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/roster.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

// --- settings, before the first window ---

/// Adds a robot; the record must outlive the run.
void add_robot(Scheduler& scheduler, Robot& robot, const char* name);
/// Sets the strategy of the explored order. It must outlive the run.
void set_decisions(Scheduler& scheduler, Decisions& decisions);
/// Before the first task: enables or disables the short cuts (default: enabled). The run is the same without them.
void use_fast_paths(Scheduler& scheduler, bool used);
/// The number of waitpoints at one instant after which a run ends without progress although tasks exchange something.
void set_instant_limit(Scheduler& scheduler, std::uint64_t waitpoints);
/// The attachments of the layers above.
Hooks& hooks(Scheduler& scheduler);
const Hooks& hooks(const Scheduler& scheduler);
/// Sets or clears a bit of a task's attention.
void attend(Task& task, std::uint8_t reason, bool needed);

// --- the state of the run ---

Time global_time(const Scheduler& scheduler);
Chooser& chooser(Scheduler& scheduler);
const Chooser& chooser(const Scheduler& scheduler);
Roster& roster(Scheduler& scheduler);
const Roster& roster(const Scheduler& scheduler);
Task* first_task(const Scheduler& scheduler);
/// The number of pending events: of ready tasks, finite timeouts, timers and messages.
std::uint32_t pending_events(const Scheduler& scheduler);
/// In the explored order, while tasks are ready: true if an event is due after this instant and within this window.
bool is_due_later(const Scheduler& scheduler);
/// True if the present instant has passed the limit of set_instant_limit().
bool is_beyond_instant_limit(const Scheduler& scheduler);

/// The number of events executed so far: a sum over all robots, too slow to be called at each event.
std::uint64_t events(const Scheduler& scheduler);
/// The number of switches between fibers.
std::uint64_t switches(const Scheduler& scheduler);

}  // namespace waitpoint::kernel
