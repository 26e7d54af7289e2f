// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/scheduler.hpp"

#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"

namespace waitpoint::kernel {

Task* running = nullptr;

namespace {

// Tells the objects of one run from those of all others in this process; never part of an event.
std::uint64_t runs = 0;

void copy_name(char (&to)[name_size], const char* from) {
  std::strncpy(to, from, name_size - 1);
  to[name_size - 1] = '\0';
}

std::uint64_t child_id(std::uint64_t parent, std::uint32_t number) {
  return Digest::mix(parent + (std::uint64_t{number} + 1) * 0x9E3779B97F4A7C15u);
}

}  // namespace

Scheduler::Scheduler(Order order, std::uint64_t seed) : events_(2 * tasks_max), chooser_(order, seed), epoch_(++runs) {}

Scheduler::~Scheduler() {
  WAITPOINT_CHECK(running == nullptr, "a run is taken down from within");
  unwind();
}

void Scheduler::add(Robot& robot, const char* name) {
  robot = Robot();
  copy_name(robot.name, name);
  robot.scheduler = this;
  Digest id;
  for (const char* c = name; *c != '\0'; ++c) id.add(static_cast<std::uint64_t>(static_cast<unsigned char>(*c)));
  robot.id = id.value();
  (last_robot_ == nullptr ? first_robot_ : last_robot_->next) = &robot;
  last_robot_ = &robot;
}

Task* Scheduler::spawn(Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument) {
  if (unwinding_ || tasks_ == tasks_max) return nullptr;
  Stack stack;
  if (!arena_.take(options.stack, stack)) return nullptr;
  // The record lies at the high end of the task's own stack: one page for both.
  char* top = stack.high - (sizeof(Task) + 63) / 64 * 64 - 64;
  Task& task = *new (top) Task();
  task.scheduler = this;
  task.robot = &robot;
  task.id = running != nullptr ? child_id(running->id, running->children++) : child_id(robot.id, robot.children++);
  task.local_time = running != nullptr ? running->local_time : now_;
  task.entry = entry;
  task.argument = argument;
  task.phase = options.phase;
  task.service = options.service;
  copy_name(task.name, options.name);
  prepare(task.fiber, stack, top, task_main, &task);

  task.previous = last_task_;
  (last_task_ == nullptr ? first_task_ : last_task_->next) = &task;
  last_task_ = &task;
  ++tasks_;
  if (!task.service) {
    ++live_tasks_;
    ++robot.live_tasks;
  }
  events_.insert(task.event, key(task, task.local_time));
  return &task;
}

// --- running ---

RunState Scheduler::run_before(Time until) {
  WAITPOINT_CHECK(running == nullptr, "run_before() is called from within a task");
  WAITPOINT_CHECK(!unwinding_, "a run that is over is run");
  until_ = until;
  if (cause_ != StopCause::none) return RunState::stopped;
  if (paused_ != nullptr) {
    Task& task = *paused_;
    paused_ = nullptr;
    switch_to(task);
  } else {
    run_next();
  }
  return state_;
}

// Goes on with the least event; comes back when it is this context's turn again.
void Scheduler::run_next() {
  for (;;) {
    if (events_.empty()) return leave_to_main(RunState::idle);
    const Time time = events_.least().key.time;
    if (time >= until_) return leave_to_main(RunState::reached);
    if (dispatch(events_.pop(), time)) return;
  }
}

// True if the event was a task's, and control has been there and come back.
bool Scheduler::dispatch(EventNode& node, Time time) {
  now_ = time;
  if (node.fire != nullptr) {
    node.fire(node);
    return false;
  }
  Task& task = reinterpret_cast<Task&>(node);  // the node is its first member
  if (task.state == TaskState::blocked) {
    remove_waiter(task);
    task.wake = Wake::timed_out;
  }
  task.local_time = time;
  switch_to(task);
  return true;
}

void Scheduler::switch_to(Task& task) {
  task.state = TaskState::running;
  Task* from = running;
  if (&task == from) return;
  WAITPOINT_CHECK(StackArena::intact(task.fiber.stack), "a task ran over the end of its stack");
  running = &task;
  switch_fiber(from != nullptr ? from->fiber : main_, task.fiber);
  reclaim_ended();
}

void Scheduler::leave_to_main(RunState state) {
  state_ = state;
  Task* from = running;
  if (from == nullptr) return;
  running = nullptr;
  switch_fiber(from->fiber, main_);
  reclaim_ended();
}

void Scheduler::stop(StopCause cause) {
  cause_ = cause;
  leave_to_main(RunState::stopped);
  rest();
}

void Scheduler::reclaim_ended() {
  if (ended_ == nullptr) return;
  const Stack stack = ended_->fiber.stack;
  ended_ = nullptr;
  arena_.give_back(stack);
}

// --- the waitpoint ---

// Whether the task's event, were it in the list, would come before `other`.
bool Scheduler::precedes(const Task& task, const EventKey& other) {
  if (task.local_time != other.time) return task.local_time < other.time;
  // First-in-first-out: at the present instant a task goes on although others tie with it. One whose time has moved on
  // comes behind them, as through the list: else it would depend on unrelated events in between.
  const std::uint64_t tie = chooser_.order() == Order::seeded ? chooser_.tie(task)
                            : task.local_time == now_         ? 0
                                                              : tie_mask;
  return make_order(task.phase, tie) <= other.order;
}

void Scheduler::arrive(Task& task) {
  for (;;) {
    if (events_.empty() || precedes(task, events_.least().key)) {
      if (task.local_time < until_) break;
      // The end of a window must not cost a task its place: it does not go through the list.
      paused_ = &task;
      task.state = TaskState::ready;
      leave_to_main(RunState::reached);
      rest();
      if (unwinding_) return;
      continue;
    }
    const Time time = events_.least().key.time;
    task.state = TaskState::ready;
    if (time >= until_) {
      events_.insert(task.event, key(task, task.local_time));
      leave_to_main(RunState::reached);
    } else if (!dispatch(events_.pop_and_insert(task.event, key(task, task.local_time)), time)) {
      run_next();
    }
    rest();
    if (unwinding_) return;
    break;
  }
  now_ = task.local_time;
}

bool Scheduler::waitpoint(Operation operation, Object* object) {
  if (unwinding_) return refuse();
  Task& task = *running;
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  take_turn(task);
  if (unwinding_) return false;
  arrive(task);
  if (unwinding_) return false;
  execute(task, operation, object);
  return true;
}

bool Scheduler::yield() {
  if (unwinding_) return refuse();
  Task& task = *running;
  task.operation = Operation::yield;
  task.at = nullptr;
  check_progress(task);
  if (unwinding_) return false;
  events_.insert(task.event, key(task, task.local_time));
  task.state = TaskState::ready;
  run_next();
  rest();
  if (unwinding_) return false;
  execute(task, Operation::yield, nullptr);
  return true;
}

bool Scheduler::sleep_until(Time time) {
  if (unwinding_) return refuse();
  Task& task = *running;
  if (time > task.local_time) task.local_time = time;
  return waitpoint(Operation::sleep, nullptr);
}

void Scheduler::execute(Task& task, Operation operation, const Object* object) {
  ++executed_;
  ++task.sequence;
  Robot& robot = *task.robot;
  if (!robot.ended) {
    ++robot.events;
    std::uint64_t what = static_cast<std::uint64_t>(operation) << 48;
    if (object != nullptr) {
      what |= object->number;
      if (object->robot != &robot) what ^= object->robot->id;
    }
    robot.digest.add(static_cast<std::uint64_t>(now_.ns()));
    robot.digest.add(task.id + what);
  }
  if (__builtin_expect(watch_ != nullptr, 0)) watch_->event(*watch_, {now_, &task, operation, object});
}

// A task that passes many waitpoints at one instant gives its ties a turn.
void Scheduler::take_turn(Task& task) {
  if (task.turns_at != task.local_time) {
    task.turns_at = task.local_time;
    task.turns = 0;
  }
  if (++task.turns <= turns_max) return;
  task.turns = 1;
  const Operation operation = task.operation;
  const Object* at = task.at;
  yield();
  task.operation = operation;
  task.at = at;
}

// If all tasks of an instant do nothing but give each other turns, the run is stuck.
void Scheduler::check_progress(Task& task) {
  if (turns_given_at_ != now_) {
    turns_given_at_ = now_;
    turns_given_ = 0;
  }
  if (++turns_given_ <= std::uint64_t{turns_max} * tasks_) return;
  culprit_ = &task;
  stop(StopCause::no_progress);
}

void Scheduler::record_output(std::uint64_t name, std::uint64_t value) {
  Robot& robot = *running->robot;
  if (robot.ended || unwinding_) return;
  robot.digest.add(name);
  robot.digest.add(value);
}

// --- blocking ---

bool Scheduler::enter(Object& object) {
  if (object.epoch == epoch_) return false;
  object.epoch = epoch_;
  object.robot = running->robot;
  object.number = ++object.robot->objects;
  object.owner = nullptr;
  object.first_waiter = object.last_waiter = nullptr;
  return true;
}

Wake Scheduler::block(Object& object, Time deadline) {
  if (unwinding_) {
    refuse();
    return Wake::unwinding;
  }
  Task& task = *running;
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = deadline != Time::max();
  if (task.finite_wait) {
    events_.insert(task.event, key(task, deadline < now_ ? now_ : deadline));
  } else if (object.owner != nullptr && owners_form_a_cycle(task)) {
    culprit_ = &task;
    stop(StopCause::deadlock);
    return Wake::unwinding;
  }
  run_next();
  rest();
  if (unwinding_) return Wake::unwinding;
  execute(task, task.wake == Wake::woken ? Operation::resume : Operation::timeout, &object);
  return task.wake;
}

bool Scheduler::owners_form_a_cycle(const Task& task) const {
  const Task* at = &task;
  // Bounded by the number of tasks: a cycle that does not contain `task` was reported when it closed.
  for (std::uint32_t hops = 0; hops <= tasks_; ++hops) {
    if (at->state != TaskState::blocked || at->finite_wait || at->blocked_on->owner == nullptr) return false;
    at = at->blocked_on->owner;
    if (at == &task) return true;
  }
  return false;
}

void Scheduler::append_waiter(Object& object, Task& task) {
  task.blocked_on = &object;
  task.next_waiter = nullptr;
  task.previous_waiter = object.last_waiter;
  (object.last_waiter == nullptr ? object.first_waiter : object.last_waiter->next_waiter) = &task;
  object.last_waiter = &task;
}

void Scheduler::remove_waiter(Task& task) {
  Object& object = *task.blocked_on;
  (task.previous_waiter == nullptr ? object.first_waiter : task.previous_waiter->next_waiter) = task.next_waiter;
  (task.next_waiter == nullptr ? object.last_waiter : task.next_waiter->previous_waiter) = task.previous_waiter;
  task.next_waiter = task.previous_waiter = nullptr;
  task.blocked_on = nullptr;
}

// Algorithm 2: who was woken takes the global time as its local one.
void Scheduler::wake(Task& task) {
  remove_waiter(task);
  if (task.event.in_list()) events_.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  task.local_time = now_;
  events_.insert(task.event, key(task, now_));
}

Task* Scheduler::wake_one(Object& object) {
  if (unwinding_ || object.epoch != epoch_ || object.first_waiter == nullptr) return nullptr;
  Task* chosen = object.first_waiter;
  if (chooser_.order() != Order::fifo) {
    std::uint32_t count = 0;
    for (Task* t = chosen; t != nullptr; t = t->next_waiter) ++count;
    for (std::uint32_t i = chooser_.waiter(*running, count); i > 0; --i) chosen = chosen->next_waiter;
  }
  wake(*chosen);
  return chosen;
}

Task* Scheduler::wake_first(Object& object) {
  if (unwinding_ || object.epoch != epoch_ || object.first_waiter == nullptr) return nullptr;
  Task* first = object.first_waiter;
  wake(*first);
  return first;
}

void Scheduler::wake_all(Object& object) {
  if (unwinding_ || object.epoch != epoch_) return;
  while (object.first_waiter != nullptr) wake(*object.first_waiter);
}

void Scheduler::schedule(EventNode& node, Time time, const Object& timer) {
  events_.insert(node, {time, make_order(Phase::deliveries, Chooser::tie(timer))});
}

}  // namespace waitpoint::kernel

extern "C" void waitpoint_describe_run() {
  using waitpoint::kernel::running;
  if (running == nullptr) return;
  const auto& task = *running;
  waitpoint::kernel::describe_run(task);
}
