// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/scheduler.hpp"

#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/fiber.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

Task* running = nullptr;
Turn turn;

namespace {

// Tells the objects of one run from those of all others in this process; never part of an event.
std::uint64_t runs = 0;

void copy_name(char (&to)[name_size], const char* from) {
  std::strncpy(to, from != nullptr ? from : "", name_size - 1);
  to[name_size - 1] = '\0';
}

}  // namespace

Scheduler::Scheduler(Order order, std::uint64_t seed) : agenda_(order, seed), epoch_(++runs) {
  free_pass_.allow(agenda_.chooser.order());
  if (running == nullptr) turn.lane = nullptr;  // of another run, whose robots may have lain where these will
  set_watch(nullptr);
  if (sanitizer::present) sanitizer::begin_run();
}

// The run goes on, in its usual order: nobody wants it to stop, or the tasks to do anything else than their own.
void Scheduler::allow_short_ways() { ordinary_ = free_pass_.may_stay() && !interrupted_; }

Scheduler::~Scheduler() {
  WAITPOINT_CHECK(running == nullptr, "a run is taken down from within");
  unwind();
  tell_debugger_of_end(*this);
  if (sanitizer::present) sanitizer::end_run();
}

void Scheduler::restart(std::uint64_t seed) {
  WAITPOINT_CHECK(running == nullptr && first_task_ == nullptr, "a run begins before the one before it is unwound");
  agenda_.restart(seed);
  epoch_ = ++runs;
  lookahead_ = Duration::max();
  first_robot_ = last_robot_ = nullptr;
  culprit_ = nullptr;
  first_abandoned_ = nullptr;
  outputs_ = switches_ = turns_given_ = 0;
  live_tasks_ = made_ = 0;
  state_ = RunState::idle;
  cause_ = StopCause::none;
  turn.lane = lane_ = nullptr;
  unheard_ = PairDigest();
  free_pass_.allow(agenda_.chooser.order());
  unwinding_ = interrupted_ = false;
  if (sanitizer::present) {
    sanitizer::end_run();
    sanitizer::begin_run();
  }
}

void Scheduler::add(Robot& robot, const char* name) {
  robot = Robot();
  copy_name(robot.name, name);
  robot.scheduler = this;
  robot.lane = &robot.digest;
  Digest id;
  for (const char* c = name; *c != '\0'; ++c) id.add(static_cast<std::uint64_t>(static_cast<unsigned char>(*c)));
  robot.id = id.value();
  (last_robot_ == nullptr ? first_robot_ : last_robot_->next) = &robot;
  last_robot_ = &robot;
}

Task* Scheduler::spawn(Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument) {
  const Time start = running != nullptr ? kernel::local_time(*running) : agenda_.now;
  if (unwinding_ || tasks_ >= most_tasks_) return nullptr;
  Stack stack;
  // Sanitizers make frames larger, and put a report together on the stack of the task that is found out.
  const StackSize size = sanitizer::present && options.stack < StackSize::large ? StackSize::large : options.stack;
  if (!arena_.take(size, stack) && (size == options.stack || !arena_.take(options.stack, stack))) return nullptr;
  // The record lies at the high end of the task's own stack: one page for both.
  char* top = stack.high - (sizeof(Task) + 63) / 64 * 64 - 64;
  Task& task = *new (top) Task();
  task.scheduler = this;
  task.robot = &robot;
  task.id = running != nullptr ? child_id(running->id, running->children++) : child_id(robot.id, robot.children++);
  task.maker = running != nullptr ? running->id : 0;
  task.number = made_++;
  task.local_time = start;
  task.entry = entry;
  task.argument = argument;
  task.phase = options.phase;
  task.service = options.service;
  set_clock(task, options.clock);
  if (options.seat != nullptr) set_seat(task, *options.seat);
  copy_name(task.name, options.name);
  prepare(task.fiber, stack, top, task_main, &task);
  if (sanitizer::present) sanitizer::name(task.fiber, task.name);

  task.previous = last_task_;
  (last_task_ == nullptr ? first_task_ : last_task_->next) = &task;
  last_task_ = &task;
  ++tasks_;
  if (!task.service) {
    ++live_tasks_;
    ++robot.live_tasks;
  }
  agenda_.place(task, task.local_time);
  if (task.local_time <= agenda_.now) free_pass_.note_present_event(task.phase);
  return &task;
}

// --- running ---

RunState Scheduler::run_before(Time until) {
  WAITPOINT_CHECK(running == nullptr, "run_before() is called from within a task");
  WAITPOINT_CHECK(!unwinding_, "a run that is over is run");
  tell_debugger(*this);
  agenda_.until = until;
  allow_short_ways();
  if (cause_ != StopCause::none) return RunState::stopped;
  if (paused_ != nullptr) {
    Task& task = *paused_;
    if (agenda_.precedes(task, agenda_.next_key())) {
      if (task.local_time >= agenda_.until) return RunState::reached;
      paused_ = nullptr;
      switch_to(task);
      return state_;
    }
    paused_ = nullptr;
    agenda_.events.insert(task.event, agenda_.key(task, task.local_time));
  }
  enter_run(next_fiber());
  return state_;
}

// Takes the least event out, and what is not a task's until one is: the fiber that goes on. Where the window or the run
// ends, that of the context outside. To be left for at once.
Fiber& Scheduler::next_fiber() {
  if (__builtin_expect(agenda_.is_explored(), 0)) return next_explored();
  for (;;) {
    if (!agenda_.present.empty() && agenda_.now < agenda_.until &&
        !(agenda_.events.least().key < EventKey{agenda_.now, agenda_.present.order()})) {
      Task& task = agenda_.present.take();
      if (agenda_.present.size() >= many_ready) fetch_coming(agenda_.present);
      resume(task);
      return task.fiber;
    }
    EventNode* node = agenda_.events.pop_before(agenda_.until);
    if (node == nullptr) return outside(pending_events() == 0 ? RunState::idle : RunState::reached);
    if (Task* task = due(*node, agenda_.events.present())) return task->fiber;
  }
}

// The task whose event it is, which is running now; null for others, which are done with.
inline Task* Scheduler::due(EventNode& node, Time time) {
  agenda_.now = time;
  if (__builtin_expect(node.fire != nullptr, 0)) {
    node.fire(node);
    return nullptr;
  }
  if (agenda_.events.is_large()) fetch_coming(agenda_.events);
  return &go(task_of(node));
}

std::uint64_t Scheduler::events() const {
  std::uint64_t hashed = unheard_.pairs();
  for (const Robot* robot = first_robot_; robot != nullptr; robot = robot->next) hashed += robot->digest.pairs();
  return hashed - outputs_;
}

Time Scheduler::next_event_time() const {
  if (paused_ != nullptr) return paused_->local_time;
  return agenda_.next_time();
}

void Scheduler::attend(Task& task, std::uint8_t reason, bool needed) {
  task.attention = static_cast<std::uint8_t>(needed ? task.attention | reason : task.attention & ~reason);
  if (&task == running) free_pass_.end();
}

Fiber& Scheduler::outside(RunState state) {
  state_ = cause_ != StopCause::none ? RunState::stopped : state;
  running = nullptr;
  free_pass_.end();
  return main_;
}

void Scheduler::switch_to(Task& task) {
  resume(task);
  enter_run(task.fiber);
}

void Scheduler::leave_to_main(RunState state) {
  state_ = state;
  if (running == nullptr) return;
  Fiber& from = running->fiber;
  free_pass_.end();
  leave(from, outside(state));
}

void Scheduler::leave_for_next(Task& task) {
  free_pass_.end();
  leave(task.fiber, next_fiber());
}

void Scheduler::stop(StopCause cause) {
  cause_ = cause;
  leave_to_main(RunState::stopped);
  if (interrupted_) rest();
}

void Scheduler::stop_between_events(StopCause cause, Task& culprit) {
  cause_ = cause;
  culprit_ = &culprit;
  pause();
}

void Scheduler::pause() {
  agenda_.until = Time();  // no event is before it
  ordinary_ = false;
  if (running != nullptr) free_pass_.end();
}

void Scheduler::reclaim_ended() {
  const Stack stack = ended_->fiber.stack;
  if (!StackArena::intact(stack)) report_overflow(*ended_);
  ended_ = nullptr;
  arena_.give_back(stack);
}

// The least event of the list is before the task's, and none of the present instant: the fiber to leave for.
Fiber& Scheduler::give_way(Task& task, const EventEntry& least) {
  task.state = TaskState::ready;
  const EventKey own = agenda_.key(task, task.local_time);
  const Time time = least.key.time;
  if (time >= agenda_.until) {
    agenda_.events.insert(task.event, own);
    return outside(RunState::reached);
  }
  Task* next = due(agenda_.events.exchange(least, task.event, own), time);
  return next != nullptr ? next->fiber : next_fiber();
}

// The same where some of the present instant are.
Fiber& Scheduler::give_way_to_present(Task& task) {
  task.state = TaskState::ready;
  agenda_.events.insert(task.event, agenda_.key(task, task.local_time));
  return next_fiber();
}

// The window ends before the task's event, which is the least. That must not cost it its place: it does not go through
// the list.
Fiber& Scheduler::wait_for_window(Task& task) {
  task.state = TaskState::ready;
  paused_ = &task;
  return outside(RunState::reached);
}

}  // namespace waitpoint::kernel

extern "C" void waitpoint_describe_run() {
  using waitpoint::kernel::running;
  if (running == nullptr) return;
  const auto& task = *running;
  waitpoint::kernel::describe_run(task);
}
