// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/scheduler.hpp"

#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/fetch.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/sanitizer.hpp"

namespace waitpoint::kernel {

Task* running = nullptr;

namespace {

// Tells the objects of one run from those of all others in this process; never part of an event.
std::uint64_t runs = 0;

bool needs_attention(const Task& task) { return __builtin_expect(task.attention != 0, 0); }

void copy_name(char (&to)[name_size], const char* from) {
  std::strncpy(to, from, name_size - 1);
  to[name_size - 1] = '\0';
}

std::uint64_t child_id(std::uint64_t parent, std::uint32_t number) {
  return Digest::mix(parent + (std::uint64_t{number} + 1) * 0x9E3779B97F4A7C15u);
}

// A parked task's registers, and the frames from its switch up to its own code.
constexpr int stack_lines_fetched = 6;

}  // namespace

Scheduler::Scheduler(Order order, std::uint64_t seed)
    : events_(2 * tasks_max), chooser_(order, seed), epoch_(++runs), may_stay_(order == Order::fifo) {
  set_watch(nullptr);
}

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
  const Time start = running != nullptr ? kernel::local_time(*running) : now_;
  if (unwinding_ || tasks_ == tasks_max) return nullptr;
  Stack stack;
  if (!arena_.take(options.stack, stack)) return nullptr;
  // The record lies at the high end of the task's own stack: one page for both.
  char* top = stack.high - (sizeof(Task) + 63) / 64 * 64 - 64;
  Task& task = *new (top) Task();
  task.scheduler = this;
  task.robot = &robot;
  task.id = running != nullptr ? child_id(running->id, running->children++) : child_id(robot.id, robot.children++);
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
  put(task.event, key(task, task.local_time));
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
    if (precedes(task, events_.least().key)) {
      if (task.local_time >= until_) return RunState::reached;
      paused_ = nullptr;
      switch_to(task);
      return state_;
    }
    paused_ = nullptr;
    events_.insert(task.event, key(task, task.local_time));
  }
  leave(main_, next_fiber());
  return state_;
}

// Takes the least event out, and what is not a task's until one is: the fiber that goes on. Where the window or the run
// ends, that of the context outside. To be left for at once.
Fiber& Scheduler::next_fiber() {
  for (;;) {
    EventNode* node = events_.pop_before(until_);
    if (node == nullptr) return outside(events_.empty() ? RunState::idle : RunState::reached);
    if (Task* task = due(*node, events_.present())) return task->fiber;
  }
}

// The task whose event it is, which is running now; null for others, which are done with.
inline Task* Scheduler::due(EventNode& node, Time time) {
  now_ = time;
  if (__builtin_expect(node.fire != nullptr, 0)) {
    node.fire(node);
    return nullptr;
  }
  prepare_coming();
  Task& task = reinterpret_cast<Task&>(node);  // the node is its first member
  if (task.state == TaskState::blocked) {
    Object& object = *task.blocked_on;
    remove_waiter(task);
    task.wake = Wake::timed_out;
    set_local_time(task, time);
    if (needs_attention(task)) stop_waiting(task, object);
  }
  resume(task);
  return &task;
}

// With many tasks, each one's record and stack are out of the cache by the time it is due: they are fetched while the
// ones before it run.
inline void Scheduler::prepare_coming() const {
  const EventNode* soon = events_.coming(0);
  if (soon == nullptr || soon->fire != nullptr) return;
  const char* stack = static_cast<const char*>(reinterpret_cast<const Task*>(soon)->fiber.context);
  for (int line = 0; line < stack_lines_fetched; ++line) fetch(stack + 64 * line);
  if (const EventNode* later = events_.coming(2)) {
    fetch(later);
    fetch(reinterpret_cast<const char*>(later) + 64);
  }
}

inline void Scheduler::resume(Task& task) {
  WAITPOINT_CHECK(StackArena::intact(task.fiber.stack), "a task ran over the end of its stack");
  task.state = TaskState::running;
  running = &task;
  hash_events_of(*task.robot);
  let_pass(task);
}

inline void Scheduler::hash_events_of(Robot& robot) { lane_ = robot.ended ? &unheard_ : &robot.digest; }

// What is left to the running task of its waitpoints at the present instant, it may pass without a look at the event
// list: they count as passed until something comes between.
inline void Scheduler::let_pass(Task& task) {
  if (!may_stay_ || task.attention != 0 || task.turns >= turns_max) return;
  free_passes_ = turns_max - task.turns;
  task.turns = turns_max;
}

inline void Scheduler::end_free_passes(Task& task) {
  task.turns -= free_passes_;
  free_passes_ = 0;
}

void Scheduler::attend(Task& task, std::uint8_t reason, bool needed) {
  task.attention = static_cast<std::uint8_t>(needed ? task.attention | reason : task.attention & ~reason);
  if (&task == running) end_free_passes(task);
}

// A new instant for the task: it may pass as many waitpoints again.
inline void Scheduler::set_local_time(Task& task, Time time) {
  if (task.local_time == time) return;
  task.local_time = time;
  task.turns = 0;
}

inline void Scheduler::put(EventNode& node, const EventKey& key) {
  events_.insert(node, key);
  if (key.time <= now_ && running != nullptr && key.order < make_order(running->phase, 0)) end_free_passes(*running);
}

Fiber& Scheduler::outside(RunState state) {
  state_ = state;
  running = nullptr;
  return main_;
}

// The one place where fibers are switched. What is decided before is decided in functions that have returned: a parked
// stack is to keep few cache lines.
inline void Scheduler::leave(Fiber& from, Fiber& to) {
  if (&from == &to) return;
  if (&from == &main_) bind_to_thread();
  switch_fiber(from, to);
  if (ended_ != nullptr) reclaim_ended();
}

void Scheduler::switch_to(Task& task) {
  resume(task);
  leave(main_, task.fiber);
}

void Scheduler::leave_to_main(RunState state) {
  state_ = state;
  if (running == nullptr) return;
  Fiber& from = running->fiber;
  end_free_passes(*running);
  leave(from, outside(state));
}

void Scheduler::leave_for_next(Task& task) { leave(task.fiber, next_fiber()); }

void Scheduler::stop(StopCause cause) {
  cause_ = cause;
  leave_to_main(RunState::stopped);
  if (interrupted_) rest();
}

void Scheduler::reclaim_ended() {
  const Stack stack = ended_->fiber.stack;
  ended_ = nullptr;
  arena_.give_back(stack);
}

// --- the waitpoint ---

// Whether the task's event, were it in the list, would come before `other`.
inline bool Scheduler::precedes(const Task& task, const EventKey& other) {
  if (task.local_time != other.time) return task.local_time < other.time;
  // First-in-first-out: at the present instant a task goes on although others tie with it. One whose time has moved on
  // comes behind them, as through the list: else it would depend on unrelated events in between.
  const std::uint64_t tie = chooser_.order() == Order::seeded ? chooser_.tie(task)
                            : task.local_time == now_         ? 0
                                                              : tie_mask;
  return make_order(task.phase, tie) <= other.order;
}

// Another event is before the task's, or the window ends: the fiber to leave for.
Fiber& Scheduler::give_way(Task& task) {
  const EventEntry& least = events_.least();
  const Time time = least.key.time;
  task.state = TaskState::ready;
  if (precedes(task, least.key)) {
    // The end of a window must not cost a task its place: it does not go through the list.
    paused_ = &task;
    return outside(RunState::reached);
  }
  const EventKey own = key(task, task.local_time);
  if (time >= until_) {
    events_.insert(task.event, own);
    return outside(RunState::reached);
  }
  Task* next = due(events_.pop_and_insert(task.event, own), time);
  return next != nullptr ? next->fiber : next_fiber();
}

// Goes on when the task's event is the least; false when the run is over.
inline bool Scheduler::arrive(Task& task) {
  if (task.local_time >= until_ || !precedes(task, events_.least().key)) {
    leave(task.fiber, give_way(task));
    if (interrupted_ && !rest()) return false;
  }
  now_ = task.local_time;
  let_pass(task);
  return true;
}

bool Scheduler::arrive_after_signal(Task& task) { return arrive(task); }

bool Scheduler::waitpoint(Operation operation, Object* object) {
  // The case that must be quick: nothing can come between.
  Task& task = *running;
  if (__builtin_expect(free_passes_ == 0 || task.local_time != now_, 0))
    return waitpoint_in_the_list(task, operation, object);
  --free_passes_;
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  execute(task, operation, object);
  return true;
}

bool Scheduler::waitpoint_in_the_list(Task& task, Operation operation, Object* object) {
  if (unwinding_) return refuse();
  end_free_passes(task);
  if (needs_attention(task)) {
    if ((task.attention & attention::timer) != 0) return act_for_timer(task, operation, object);
    if (!end_segment(task)) return false;
  }
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  if (task.local_time != now_)
    task.turns = 1;
  else if (++task.turns > turns_max && !give_turn(task))
    return false;
  if (!arrive(task)) return false;
  if (needs_attention(task) && !begin_segment(task, operation, object)) return false;
  execute(task, operation, object);
  return true;
}

bool Scheduler::yield() {
  if (unwinding_) return refuse();
  Task& task = *running;
  end_free_passes(task);
  if (needs_attention(task)) {
    WAITPOINT_CHECK((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(task)) return false;
    if (task.seat != nullptr) leave_processor(task);
  }
  task.operation = Operation::yield;
  task.at = nullptr;
  if (task.local_time != now_) task.turns = 0;
  check_progress(task);
  if (unwinding_) return false;
  events_.insert(task.event, key(task, task.local_time));
  task.state = TaskState::ready;
  leave(task.fiber, next_fiber());
  if (interrupted_ && !rest()) return false;
  if (needs_attention(task) && !begin_segment(task, Operation::yield, nullptr)) return false;
  execute(task, Operation::yield, nullptr);
  return true;
}

bool Scheduler::sleep_until(Time time) {
  if (unwinding_) return refuse();
  Task& task = *running;
  if (needs_attention(task)) {
    if (!end_segment(task)) return false;
    if (task.seat != nullptr && time > task.local_time) leave_processor(task);
  }
  if (time > task.local_time) task.local_time = time;
  return waitpoint(Operation::sleep, nullptr);
}

// Whatever a timer does, it does in its turn: its event is the one now executing.
bool Scheduler::act_for_timer(Task& task, Operation operation, Object* object) {
  WAITPOINT_CHECK(operation != Operation::sleep, "a timer's callback waits");
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  hash_events_of(*task.robot);
  execute(task, operation, object);
  return true;
}

inline void Scheduler::execute(Task& task, Operation operation, const Object* object) {
  ++executed_;
  ++task.sequence;
  std::uint64_t what = static_cast<std::uint64_t>(operation) << 48;
  if (object != nullptr) what ^= object->identity;
  lane_->add(static_cast<std::uint64_t>(now_.ns()), task.id + what);
  if (__builtin_expect(watched_, 0)) show({now_, &task, operation, object});
}

void Scheduler::set_watch(Watch* watch) {
  watch_ = watch;
  watched_ = watch != nullptr || sanitizer::present;
}

void Scheduler::show(const EventRecord& record) {
  // Every use of an object comes after all earlier ones.
  if (sanitizer::present && record.object != nullptr) {
    sanitizer::acquire(record.object);
    sanitizer::release(record.object);
  }
  if (watch_ != nullptr) watch_->event(*watch_, record);
}

void Scheduler::begin(Task& task) {
  if (needs_attention(task) && !begin_segment(task, Operation::start, nullptr)) return;
  execute(task, Operation::start, nullptr);
}

// A task that passes many waitpoints at one instant gives its ties a turn; false when the run is over.
bool Scheduler::give_turn(Task& task) {
  task.turns = 1;
  const Operation operation = task.operation;
  const Object* at = task.at;
  if (!yield()) return false;
  task.operation = operation;
  task.at = at;
  return true;
}

// If all tasks of an instant do nothing but give each other turns, the run is stuck.
void Scheduler::check_progress(Task& task) {
  if (turns_given_at_ != now_) {
    turns_given_at_ = now_;
    turns_given_ = 0;
  }
  if (++turns_given_ <= idle_turns_max + std::uint64_t{turns_max} * tasks_) return;
  culprit_ = &task;
  stop(StopCause::no_progress);
}

void Scheduler::record_output(std::uint64_t name, std::uint64_t value) {
  if (!unwinding_) lane_->add(name, value);
}

// --- blocking ---

void Scheduler::adopt(Object& object) {
  object.epoch = epoch_;
  object.robot = running->robot;
  object.number = ++object.robot->objects;
  object.identity = child_id(object.robot->id, object.number);
  object.owner = nullptr;
  object.holder_count = object.users = 0;
  object.first_waiter = object.last_waiter = nullptr;
}

Wake Scheduler::block(Object& object, Time deadline) {
  if (unwinding_) {
    refuse();
    return Wake::unwinding;
  }
  Task& task = *running;
  WAITPOINT_CHECK((task.attention & attention::timer) == 0, "a timer's callback waits");
  leave(task.fiber, park(task, object, deadline));
  if (interrupted_ && !rest()) return Wake::unwinding;
  const Wake wake = task.wake;
  const Operation operation = wake == Wake::woken ? Operation::resume : Operation::timeout;
  if (needs_attention(task) && !begin_segment(task, operation, &object)) return Wake::unwinding;
  execute(task, operation, &object);
  return wake;
}

bool Scheduler::suspend(Object& object) {
  if (unwinding_) return false;
  Task& task = *running;
  end_free_passes(task);
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = false;
  leave(task.fiber, next_fiber());
  return !interrupted_ || rest();
}

// The task waits from now on: the fiber to leave for.
Fiber& Scheduler::park(Task& task, Object& object, Time deadline) {
  end_free_passes(task);
  if (sanitizer::present) sanitizer::release(&object);
  append_waiter(object, task);
  if (needs_attention(task)) start_waiting(task, object);
  task.state = TaskState::blocked;
  task.finite_wait = deadline != Time::max();
  if (task.finite_wait) {
    events_.insert(task.event, key(task, deadline < now_ ? now_ : deadline));
  } else if ((object.owner != nullptr || object.holder_count != 0) && closes_a_cycle(task)) {
    cause_ = StopCause::deadlock;
    return outside(RunState::stopped);
  }
  return next_fiber();
}

inline void Scheduler::append_waiter(Object& object, Task& task) {
  task.blocked_on = &object;
  task.next_waiter = nullptr;
  task.previous_waiter = object.last_waiter;
  (object.last_waiter == nullptr ? object.first_waiter : object.last_waiter->next_waiter) = &task;
  object.last_waiter = &task;
}

inline void Scheduler::remove_waiter(Task& task) {
  Object& object = *task.blocked_on;
  (task.previous_waiter == nullptr ? object.first_waiter : task.previous_waiter->next_waiter) = task.next_waiter;
  (task.next_waiter == nullptr ? object.last_waiter : task.next_waiter->previous_waiter) = task.previous_waiter;
  task.blocked_on = nullptr;
}

// Algorithm 2: who was woken takes the global time as its local one.
inline void Scheduler::make_ready(Task& task) {
  if (__builtin_expect(sanitizer::present, 0)) sanitizer::release(task.blocked_on);
  remove_waiter(task);
  if (task.event.in_list()) events_.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  set_local_time(task, now_);
  put(task.event, key(task, now_));
}

void Scheduler::wake(Task& task) { make_ready(task); }

Task* Scheduler::wake_one(Object& object) {
  Task* chosen = object.first_waiter;
  if (chosen == nullptr || unwinding_ || object.epoch != epoch_) return nullptr;
  if (chooser_.order() != Order::fifo) {
    std::uint32_t count = 0;
    for (Task* t = chosen; t != nullptr; t = t->next_waiter) ++count;
    for (std::uint32_t i = chooser_.waiter(*running, count); i > 0; --i) chosen = chosen->next_waiter;
  }
  make_ready(*chosen);
  return chosen;
}

Task* Scheduler::wake_first(Object& object) {
  if (unwinding_ || object.epoch != epoch_ || object.first_waiter == nullptr) return nullptr;
  Task* first = object.first_waiter;
  make_ready(*first);
  return first;
}

void Scheduler::wake_all(Object& object) {
  if (unwinding_ || object.epoch != epoch_) return;
  while (object.first_waiter != nullptr) make_ready(*object.first_waiter);
}

void Scheduler::schedule(EventNode& node, Time time, const Object& timer, Phase phase) {
  put(node, {time, make_order(phase, Chooser::tie(timer))});
}

void Scheduler::deliver(EventNode& node, Time time, Robot& sender) {
  put(node, {time, make_order(Phase::deliveries, Chooser::tie(sender, ++sender.messages))});
}

void Scheduler::declare_latency(Duration least) {
  WAITPOINT_CHECK(least > Duration(), "a link between robots has no latency");
  if (least < lookahead_) lookahead_ = least;
}

}  // namespace waitpoint::kernel

extern "C" void waitpoint_describe_run() {
  using waitpoint::kernel::running;
  if (running == nullptr) return;
  const auto& task = *running;
  waitpoint::kernel::describe_run(task);
}
