// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/signals.hpp"

#include <array>
#include <utility>

#include "core/digest.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/robot_state.hpp"
#include "fibers/sync/run_context.hpp"

namespace waitpoint {
namespace sync {

using Handlers = std::array<signal_handler, signals_max>;

/// A task's signal state, from its first use of signals on.
struct TaskSignals {
  Handlers handlers;
  signal_set pending;
  signal_set blocked;
};

namespace {

struct RobotSignals : RobotState {
  explicit RobotSignals(kernel::Robot&) {}
  Handlers handlers;
};

signal_handler& slot(Handlers& handlers, int signal) { return handlers[static_cast<std::size_t>(signal - 1)]; }

TaskSignals& signals_of(ThreadState& state) {
  if (state.signals == nullptr) state.signals = std::make_shared<TaskSignals>();
  return *state.signals;
}

ThreadState& running_thread() {
  ThreadState* state = thread_of(running_task());
  WAITPOINT_REQUIRE(state != nullptr, "a task that is not a thread has no signals");
  return *state;
}

void set_attention(kernel::Task& task, const TaskSignals& signals) {
  const bool deliverable = !(signals.pending - signals.blocked).empty();
  kernel::attend(task, kernel::attention::signal, deliverable);
}

signal_sent post(ThreadState& to, int signal) {
  if (to.task == nullptr) return signal_sent::task_ended;
  TaskSignals& signals = signals_of(to);
  signals.pending.add(signal);
  kernel::sanitizer::release(&signals);
  set_attention(*to.task, signals);
  return signal_sent::pending;
}

void handle(kernel::Task& task, TaskSignals& signals, int signal) {
  // A copy: the handler may replace itself.
  signal_handler handler = slot(signals.handlers, signal);
  if (!handler) handler = slot(state_of<RobotSignals>(*task.robot).handlers, signal);
  WAITPOINT_REQUIRE(handler, "a signal is delivered to a task that has no handler for it");
  static constexpr std::uint64_t delivered = 0x7369676E616C;  // "signal"
  kernel::record_output(delivered, static_cast<std::uint64_t>(signal));
  handler(signal);
}

}  // namespace

void deliver_signals(kernel::Task& task) {
  ThreadState* state = thread_of(task);
  if (state == nullptr) return;
  TaskSignals& signals = *state->signals;
  try {
    while (!(signals.pending - signals.blocked).empty()) {
      const int signal = (signals.pending - signals.blocked).least();
      signals.pending.remove(signal);
      kernel::sanitizer::acquire(&signals);  // the sending happened before
      const signal_set blocked = signals.blocked;
      signals.blocked.add(signal);
      set_attention(task, signals);
      handle(task, signals, signal);
      signals.blocked = blocked;
    }
  } catch (const Unwind&) {
    // The call at this waitpoint rethrows it, if it may.
  } catch (...) {
    if (!kernel::is_unwinding(*task.scheduler)) RunContext::of(*task.scheduler).fail(std::current_exception());
  }
  set_attention(task, signals);
}

}  // namespace sync

signal_sent send_signal(const thread& to, int signal) {
  WAITPOINT_REQUIRE(to.state_ != nullptr, "a signal is sent through an empty thread handle");
  WAITPOINT_REQUIRE(signal >= 1 && signal <= signals_max, "no signal has this number");
  if (!sync::before_releasing(kernel::Operation::signal, to.state_->ended)) return signal_sent::task_ended;
  return sync::post(*to.state_, signal);
}

signal_sent send_signal(thread::id to, int signal) {
  WAITPOINT_REQUIRE(signal >= 1 && signal <= signals_max, "no signal has this number");
  kernel::Scheduler& scheduler = *sync::running_task().scheduler;
  if (!kernel::waitpoint(scheduler, kernel::Operation::signal, nullptr)) return signal_sent::task_ended;
  for (kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
    if (thread::id(task->id) == to) {
      sync::ThreadState* state = sync::thread_of(*task);
      return state != nullptr ? sync::post(*state, signal) : signal_sent::task_ended;
    }
  return signal_sent::task_ended;
}

void handle_robot_signal(int signal, signal_handler handler) {
  WAITPOINT_REQUIRE(signal >= 1 && signal <= signals_max, "no signal has this number");
  sync::slot(sync::state_of<sync::RobotSignals>(*sync::running_task().robot).handlers, signal) = std::move(handler);
}

namespace this_thread {

void handle_signal(int signal, signal_handler handler) {
  WAITPOINT_REQUIRE(signal >= 1 && signal <= signals_max, "no signal has this number");
  sync::slot(sync::signals_of(sync::running_thread()).handlers, signal) = std::move(handler);
}

void raise_signal(int signal) {
  WAITPOINT_REQUIRE(signal >= 1 && signal <= signals_max, "no signal has this number");
  sync::ThreadState& self = sync::running_thread();
  sync::post(self, signal);
  sync::before_blocking(kernel::Operation::signal, self.ended);
}

signal_set block_signals(signal_set blocked) {
  sync::TaskSignals& signals = sync::signals_of(sync::running_thread());
  const signal_set before = std::exchange(signals.blocked, signals.blocked | blocked);
  sync::set_attention(sync::running_task(), signals);
  return before;
}

signal_set unblock_signals(signal_set unblocked) {
  sync::ThreadState& self = sync::running_thread();
  sync::TaskSignals& signals = sync::signals_of(self);
  const signal_set before = std::exchange(signals.blocked, signals.blocked - unblocked);
  sync::set_attention(sync::running_task(), signals);
  if (!(signals.pending - signals.blocked).empty()) sync::before_blocking(kernel::Operation::signal, self.ended);
  return before;
}

signal_set blocked_signals() { return sync::signals_of(sync::running_thread()).blocked; }

signal_set pending_signals() { return sync::signals_of(sync::running_thread()).pending; }

}  // namespace this_thread
}  // namespace waitpoint
