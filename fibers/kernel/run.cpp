// SPDX-License-Identifier: BSD-3-Clause
//
// The run as a whole: windows, pauses, stops, and queries.
#include <atomic>

#include "core/error.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/fiber.hpp"
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

Scheduler::Scheduler(Order order, std::uint64_t seed) : agenda_(order, seed), epoch_(++runs) {
  fast_path_.allow(agenda_.chooser.order());
  set_watch(nullptr);
  if (sanitizer::present) sanitizer::begin_run();
}

Scheduler::~Scheduler() {
  WAITPOINT_CHECK(running == nullptr, "a scheduler is destroyed from within a task");
  unwind();
  tell_debugger_of_end(*this);
  if (sanitizer::present) sanitizer::end_run();
}

void Scheduler::restart(std::uint64_t seed) {
  WAITPOINT_CHECK(running == nullptr && first_task() == nullptr, "a scheduler is restarted before its run is unwound");
  agenda_.restart(seed);
  epoch_ = ++runs;
  lookahead_ = Duration::max();
  roster_.restart();
  culprit_ = nullptr;
  switches_ = idle_yields_ = waitpoints_at_instant_ = 0;
  state_ = RunState::idle;
  cause_ = StopCause::none;
  thread_ = nullptr;
  fast_path_.allow(agenda_.chooser.order());
  unwinding_ = interrupted_ = false;
  if (sanitizer::present) {
    sanitizer::end_run();
    sanitizer::begin_run();
  }
}

// --- running ---

// The frames of its tasks may hold addresses of the thread's variables.
void Scheduler::stay_on_thread() {
  if (thread_ == __builtin_thread_pointer()) return;
  WAITPOINT_REQUIRE(thread_ == nullptr,
                    "a simulation is continued in another thread than the one that began to run it");
  thread_ = __builtin_thread_pointer();
  turn.digest = digest_in_use_ = nullptr;  // of a previous run, whose robots may have had the same addresses
}

RunState Scheduler::run_before(Time until) {
  WAITPOINT_CHECK(running == nullptr, "run_before() is called from within a task");
  WAITPOINT_CHECK(!unwinding_, "run_before() is called after the run is over");
  stay_on_thread();
  tell_debugger(*this);
  agenda_.until = until;
  allow_fast_paths();
  if (cause_ != StopCause::none) return RunState::stopped;
  if (paused_ != nullptr) {
    Task& task = *paused_;
    if (agenda_.precedes(task, agenda_.next_key())) {
      if (task.local_time >= agenda_.until) return RunState::reached;
      paused_ = nullptr;
      enter_run(resume(task));
      return state_;
    }
    paused_ = nullptr;
    agenda_.events.insert(task.event, agenda_.key(task, task.local_time));
  }
  enter_run(dispatch());
  return state_;
}

Time Scheduler::next_event_time() const {
  if (paused_ != nullptr) return paused_->local_time;
  return agenda_.next_time();
}

EventKey Scheduler::next_key() {
  if (paused_ != nullptr) return agenda_.key_in_turn(*paused_);
  return agenda_.ready.empty() ? agenda_.next_key() : EventKey{agenda_.now, make_order(Phase::tasks, 0)};
}

void Scheduler::advance(Time time) {
  WAITPOINT_CHECK(running == nullptr && agenda_.now <= time && time <= next_event_time(),
                  "the global time moves back, or over an event");
  agenda_.advance(time);
}

void Scheduler::attend(Task& task, std::uint8_t reason, bool needed) {
  task.attention = static_cast<std::uint8_t>(needed ? task.attention | reason : task.attention & ~reason);
  if (&task == running) fast_path_.close();
}

// Returns the main fiber, to leave the run with `state`.
Fiber& Scheduler::end_window(RunState state) {
  state_ = cause_ != StopCause::none ? RunState::stopped : state;
  running = nullptr;
  fast_path_.close();
  return main_;
}

void Scheduler::exit_run(RunState state) {
  state_ = state;
  if (running == nullptr) return;
  Fiber& from = running->fiber;
  fast_path_.close();
  switch_fibers(from, end_window(state));
}

void Scheduler::stop(StopCause cause) {
  cause_ = cause;
  exit_run(RunState::stopped);
  if (interrupted_) answer_interrupt();
}

void Scheduler::go_on_after_end() {
  WAITPOINT_CHECK(cause_ == StopCause::ended, "a run goes on after its end without one");
  cause_ = StopCause::none;
}

void Scheduler::stop_between_events(StopCause cause, Task& culprit) {
  cause_ = cause;
  culprit_ = &culprit;
  pause();
}

void Scheduler::pause() {
  agenda_.until = Time();  // no event is before it
  fast_allowed_ = false;
  if (running != nullptr) fast_path_.close();
}

void Scheduler::reclaim_ended() {
  const Stack stack = ended_->fiber.stack;
  if (!StackArena::intact(stack)) report_overflow(*ended_);
  ended_ = nullptr;
  arena_.give_back(stack);
}

void Scheduler::set_watch(Watch* watch) {
  fast_path_.close();  // the fast path does not show events
  watch_ = watch;
  watched_ = watch != nullptr || sanitizer::present || debugger_view.watching;
}

// The window ends before the task's event, which is the least. The event is not inserted into the list, to keep its
// place among its ties.
Fiber& Scheduler::wait_for_window(Task& task) {
  task.state = TaskState::ready;
  paused_ = &task;
  return end_window(RunState::reached);
}

}  // namespace waitpoint::kernel
