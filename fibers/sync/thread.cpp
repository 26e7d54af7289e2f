// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/thread.hpp"

#include <cstdio>
#include <ostream>
#include <system_error>

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/tasks.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/sync/report/misuse.hpp"
#include "fibers/sync/run_context.hpp"

namespace waitpoint {
namespace sync {
namespace {

// Destroys thread-locals after the thread's function. If it was left by an exception, that is then in flight, so that
// destructors need not wait.
struct LocalsEnd {
  ~LocalsEnd() { state.locals.clear(); }
  ThreadState& state;
};

// At the end of a thread.
void check_holds_nothing(const kernel::Task& task) {
  WAITPOINT_REQUIRE(task.held == nullptr, about(*task.held, "a thread ends while it holds a lock"));
  WAITPOINT_REQUIRE(task.held_shared == 0, "a thread ends while it holds a lock together with others");
}

void run_thread(void* argument) {
  // The handle may be destroyed before.
  const std::shared_ptr<ThreadState> share = std::move(static_cast<ThreadState*>(argument)->share);
  ThreadState& state = *share;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  try {
    const LocalsEnd locals_end{state};
    const std::unique_ptr<Call> call = std::move(state.call);
    // The function's captures are destroyed while an exception is in flight, so that their destructors need not wait.
    if (kernel::is_unwinding(scheduler)) throw Unwind();
    call->run();
    if (!kernel::is_unwinding(scheduler)) check_holds_nothing(*kernel::running);
  } catch (const Unwind&) {
  } catch (...) {
    // While unwinding, this is an exception that the task made of Unwind.
    if (!kernel::is_unwinding(scheduler)) RunContext::of(scheduler).fail(std::current_exception());
  }
  for (const std::function<void()>& make_ready : std::exchange(state.at_end, {})) make_ready();
  if (before_releasing(kernel::Operation::release, state.ended)) {
    state.ended.owner = nullptr;
    kernel::wake_all(scheduler, state.ended);
  }
  // These are destroyed with the state.
  kernel::vacate(*kernel::running);
  kernel::set_clock(*kernel::running, nullptr);
  state.task = nullptr;
  kernel::running->argument = nullptr;
  state.run_over = kernel::is_unwinding(scheduler);
}

// As std::thread does.
[[noreturn]] void refuse(const kernel::Scheduler& scheduler, const kernel::Robot& robot,
                         const kernel::SpawnOptions& options) {
  const bool all_made = kernel::roster(scheduler).is_full();
  throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again),
                          std::string("thread ") + options.name + " of " + robot.name + " cannot be created: " +
                              (all_made ? "the run has " + std::to_string(kernel::roster(scheduler).tasks()) +
                                              " tasks, the most allowed at once"
                                        : "no stack of " + std::to_string(kernel::bytes(options.stack) / 1024) +
                                              " KiB is left, their address space is used up"));
}

}  // namespace

ThreadState* thread_of(const kernel::Task& task) {
  if (task.entry != run_thread || task.argument == nullptr) return nullptr;
  return static_cast<ThreadState*>(task.argument);
}

LocalValues& values_of_running_task() {
  ThreadState* thread = thread_of(running_task());
  WAITPOINT_REQUIRE(thread != nullptr, "a task that is not a thread has no thread-local values");
  return thread->locals;
}

std::shared_ptr<ThreadState> start_thread(kernel::Scheduler& scheduler, kernel::Robot& robot,
                                          kernel::SpawnOptions options, std::unique_ptr<Call> call,
                                          const Computing& computing) {
  auto state = std::make_shared<ThreadState>();
  state->call = std::move(call);
  if (!computing.clock.plain()) options.clock = &state->clock.emplace(computing.clock);
  if (computing.on != nullptr) options.seat = &state->seat.emplace(computing.on->core(), computing.priority);
  state->task = kernel::spawn(scheduler, robot, options, run_thread, state.get());
  if (state->task == nullptr) {
    if (!kernel::is_unwinding(scheduler)) refuse(scheduler, robot, options);
    return state;
  }
  state->share = state;
  state->id = state->task->id;
  return state;
}

}  // namespace sync

std::shared_ptr<sync::ThreadState> thread::start(const thread_attributes& attributes,
                                                 std::unique_ptr<sync::Call> call) {
  kernel::Task& parent = sync::running_task();
  const kernel::SpawnOptions options{attributes.name, attributes.stack, parent.phase, attributes.service};
  const sync::Computing computing{attributes.clock, attributes.on, attributes.priority};
  return sync::start_thread(*parent.scheduler, *parent.robot, options, std::move(call), computing);
}

thread& thread::operator=(thread&& other) noexcept {
  WAITPOINT_REQUIRE(!joinable(), "a thread that is joinable is assigned to");
  state_ = std::move(other.state_);
  return *this;
}

thread::~thread() {
  if (!joinable()) return;
  // Outside any task, a thread that ended with its run is detached already.
  const bool let_go =
      kernel::running != nullptr ? kernel::is_unwinding(*kernel::running->scheduler) : state_->task == nullptr;
  WAITPOINT_REQUIRE(let_go, "a thread that is joinable is destroyed");
}

namespace {

// At the end of a run threads are unwound in no order of the program's: nothing is a misuse then.
bool run_is_over() { return kernel::running != nullptr && kernel::is_unwinding(*kernel::running->scheduler); }

}  // namespace

void thread::join() {
  if (run_is_over()) return sync::unwind();
  WAITPOINT_REQUIRE(joinable(), "a thread that is not joinable is joined");
  if (sync::before_blocking(kernel::Operation::join, state_->ended) && state_->task != nullptr) {
    state_->ended.owner = state_->task;
    sync::block(state_->ended);
  }
  state_ = nullptr;
}

bool thread::join_before(Time deadline) {
  if (run_is_over()) {
    sync::unwind();
    return false;
  }
  WAITPOINT_REQUIRE(joinable(), "a thread that is not joinable is joined");
  if (!sync::before_blocking(kernel::Operation::join, state_->ended)) return false;
  if (state_->task != nullptr) {
    if (deadline <= now()) return false;
    state_->ended.owner = state_->task;
    if (!sync::block(state_->ended, deadline)) return false;
  }
  state_ = nullptr;
  return true;
}

void thread::await_end() noexcept {
  if (!joinable() || kernel::running == nullptr) return;
  sync::ThreadState& state = *state_;
  if (sync::before_releasing(kernel::Operation::join, state.ended) && state.task != nullptr) {
    state.ended.owner = state.task;
    kernel::block(*kernel::running->scheduler, state.ended, Time::max());
  }
  state_ = nullptr;
}

void thread::detach() {
  WAITPOINT_REQUIRE(run_is_over() || joinable(), "a thread that is not joinable is detached");
  state_ = nullptr;
}

unsigned thread::hardware_concurrency() noexcept {
  if (kernel::running == nullptr) return 0;
  return sync::RunContext::of(*kernel::running->scheduler).hardware_concurrency();
}

std::ostream& operator<<(std::ostream& out, thread::id of) {
  if (of == thread::id()) return out << "no thread";
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(of.value_));
  return out << text;
}

}  // namespace waitpoint
