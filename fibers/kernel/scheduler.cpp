// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/run.hpp"

#include <atomic>

#include "core/error.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

// In one cache line.
alignas(64) constinit thread_local Task* running = nullptr;
constinit thread_local Turn turn;

namespace {

// The epoch of the latest run, which distinguishes objects of different runs in this process, in whatever threads;
// never part of an event.
std::atomic<std::uint64_t> runs = 0;

}  // namespace

// --- the record's life ---

Scheduler::Scheduler(Order order, std::uint64_t seed) : agenda(order, seed), epoch(++runs) {
  fast_path.allow(agenda.chooser.order());
  set_watch(*this, nullptr);
  if (sanitizer::present) sanitizer::begin_run();
}

Scheduler::~Scheduler() {
  WAITPOINT_CHECK(running == nullptr, "a scheduler is destroyed from within a task");
  unwind(*this);
  tell_debugger_of_end(*this);
  if (sanitizer::present) sanitizer::end_run();
}

void Scheduler::restart(std::uint64_t seed) {
  WAITPOINT_CHECK(running == nullptr && roster.first_task() == nullptr,
                  "a scheduler is restarted before its run is unwound");
  agenda.restart(seed);
  epoch = ++runs;
  least_latency = Duration::max();
  roster.restart();
  switches = 0;
  progress.restart();
  window.restart();
  fast_path.allow(agenda.chooser.order());
  interruption = Interruption();
  if (sanitizer::present) {
    sanitizer::end_run();
    sanitizer::begin_run();
  }
}

// --- settings ---

void add_robot(Scheduler& scheduler, Robot& robot, const char* name) { scheduler.roster.add(robot, name, scheduler); }

void use_fast_paths(Scheduler& scheduler, bool used) {
  WAITPOINT_CHECK(running == nullptr && first_task(scheduler) == nullptr, "the fast paths are chosen while tasks run");
  scheduler.fast_path.enable(used);
  scheduler.fast_path.allow(scheduler.agenda.chooser.order());
}

void set_instant_limit(Scheduler& scheduler, std::uint64_t waitpoints) { scheduler.progress.set_limit(waitpoints); }
Hooks& hooks(Scheduler& scheduler) { return scheduler.hooks; }
const Hooks& hooks(const Scheduler& scheduler) { return scheduler.hooks; }

void attend(Task& task, std::uint8_t reason, bool needed) {
  task.attention = static_cast<std::uint8_t>(needed ? task.attention | reason : task.attention & ~reason);
  if (&task == running) turn.close();
}

// --- the state of the run ---

Time global_time(const Scheduler& scheduler) { return scheduler.agenda.now; }
Chooser& chooser(Scheduler& scheduler) { return scheduler.agenda.chooser; }
const Chooser& chooser(const Scheduler& scheduler) { return scheduler.agenda.chooser; }
Roster& roster(Scheduler& scheduler) { return scheduler.roster; }
const Roster& roster(const Scheduler& scheduler) { return scheduler.roster; }
Task* first_task(const Scheduler& scheduler) { return scheduler.roster.first_task(); }
std::uint32_t pending_events(const Scheduler& scheduler) { return scheduler.agenda.size(); }
bool is_due_later(const Scheduler& scheduler) { return scheduler.agenda.is_due_later(); }
bool is_beyond_instant_limit(const Scheduler& scheduler) { return scheduler.progress.is_beyond_limit(); }
std::uint64_t events(const Scheduler& scheduler) { return scheduler.roster.events(); }
std::uint64_t switches(const Scheduler& scheduler) { return scheduler.switches; }

}  // namespace waitpoint::kernel
