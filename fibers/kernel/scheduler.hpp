// SPDX-License-Identifier: BSD-3-Clause
// The scheduler is the event list (the paper's Algorithms 1 and 2).
//
// Every primitive begins with waitpoint(): the task's event stands in the list at its local virtual time, and the task
// goes on when that event is the least. The global time is the time of the event now executing; it never goes back. So
// all uses of primitives happen in time order, whatever computing the tasks do between them.
//
// Hand-over is direct, from the fiber that cannot go on to the one whose event is next. A task whose own event is the
// least already does not switch at all. The context that called run_before() is re-entered only when the run stops.
//
// The plain path is waitpoint.cpp and waiting.cpp; fast_path.hpp and fast_calls.cpp come to the same events in fewer
// steps.
//
// Nothing here throws, allocates while running, or prints.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/agenda.hpp"
#include "fibers/kernel/fast_path.hpp"
#include "fibers/kernel/hooks.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/run_state.hpp"
#include "fibers/kernel/spawn_options.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/wait_graph.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/switch/departure.hpp"
#include "fibers/switch/stack_arena.hpp"

namespace waitpoint::kernel {

class Scheduler {
 public:
  Scheduler(Order order, std::uint64_t seed);
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Whether a scheduler can be made: the process may have little address space (ulimit -v).
  static bool has_address_space() { return EventList::has_address_space(events_max); }

  /// In the explored order, before the first run_before(): who decides. It must outlive the run.
  void set_decisions(Decisions& decisions);

  /// Before the first task: whether events may take the fast paths (they do by default). The run is the same without.
  void use_fast_paths(bool used);

  /// After unwind(): all is as in a new scheduler of this seed, which has no robot yet; but its memory is in place.
  /// Takes a microsecond.
  void restart(std::uint64_t seed);

  /// Adds a robot; the record must outlive the run.
  void add(Robot& robot, const char* name);

  /// A new task of `robot`, starting at the local time of the caller (at the start of the run from outside). Null when
  /// there are most_tasks() already, or no stack is left.
  Task* spawn(Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument);

  /// Executes all events before `until`.
  RunState run_before(Time until);
  StopCause stop_cause() const { return cause_; }
  /// Stops the run from within a task; run_before() returns at once.
  void stop(StopCause cause);
  /// As stop(), for what acts between tasks: no other event is executed.
  void stop_between_events(StopCause cause, Task& culprit);
  /// From a task or a watch: run_before() returns before another event is executed, as if its window ended here. The
  /// next call goes on as if there had been no pause.
  void pause();

  /// Takes every task that is left off its stack: blocking calls report Wake::unwinding. The run is over then. The
  /// youngest task goes first: what a task borrows from its maker's frames is still there.
  void unwind();
  /// In a process that was forked from within a task: the others are not there any more, whatever they held or waited
  /// for. Their stacks stay as they are.
  void keep_running_task_only();
  /// Another task than the running one is not there any more: nothing is unwound, what it owns is nobody's. Its stack
  /// stays as it is, for free_stack().
  void end_in_place(Task& task);
  /// Gives back the stack of a task ended so, and its record with it.
  void free_stack(const Task& task) { arena_.give_back(Stack(task.fiber.stack)); }
  /// The running task ends where it is, after the waitpoint of its end: nothing is unwound.
  [[noreturn]] void end_running_task();
  /// Gives up the running task, which cannot or does not leave its frames while it is unwound: what they own leaks.
  [[noreturn]] void abandon();
  /// The tasks given up so, linked by `next`.
  const Task* first_abandoned() const { return first_abandoned_; }

  // --- what primitives are made of; only within a task ---

  /// The task's event stands at its local time; returns when it is the least. False while unwinding.
  bool waitpoint(Operation operation, Object* object) {
    if (object != nullptr && try_fast_waitpoint(operation, *object)) return true;
    return waitpoint_slow(operation, object);
  }
  /// The same for a caller that has tried the fast path already.
  bool waitpoint_slow(Operation operation, Object* object);
  /// The running task reads its clock: no event, but a task that reads it again and again gives others a turn after as
  /// many reads as waitpoints at one instant. False when the run is over.
  bool read_clock(Time& local) {
    Task& task = *running;
    if (__builtin_expect(!fast_path_.holds_for(task), 0)) return read_clock_slow(task, local);
    ++task.turns;
    local = task.local_time;
    return true;
  }
  /// The running task's local time moves on: it is not of the present instant any more.
  void close_fast_path() { fast_path_.close(); }
  /// As waitpoint, but behind all tasks of this instant; in the seeded order anywhere among them.
  bool yield();
  /// Moves the task to `time` (not before its local time) and waits there.
  [[gnu::always_inline]] bool sleep_until(Time time) {
    const Departure away = start_sleep(time);
    return away.leads_away() ? end_sleep(depart(away)) : wake_of(away) != Wake::unwinding;
  }
  /// Blocks the running task on `object` until it is woken or `deadline` comes; Time::max() is for ever.
  [[gnu::always_inline]] Wake block(Object& object, Time deadline) {
    // Two instances, since the deadline is mostly a constant: the compiler then chooses, and no test is left.
    const bool is_finite = deadline != Time::max();
    const Departure away = is_finite ? start_block<true>(object, deadline) : start_block<false>(object, deadline);
    return away.leads_away() ? end_block(depart(away), object, is_finite) : wake_of(away);
  }
  /// Wakes one waiter of `object`, of the chooser's choice; null if there is none. The waiter's local time becomes the
  /// global.
  Task* wake_one(Object& object) { return object.first_waiter == nullptr ? nullptr : wake_waiter(object); }
  void wake_all(Object& object);
  /// Wakes `task`, which must be blocked: for primitives that choose among their waiters themselves.
  void wake(Task& task);
  /// `task`, which must be blocked, waits for `to` from now on, as long as before; nobody may hold either object.
  void move_waiter(Task& task, Object& to);
  /// As wake_one, but the first: for timers, which are no tasks and leave no choice.
  Task* wake_first(Object& object);
  /// Makes `object` belong to this run; true if it was not yet, so that a primitive can take its initial state.
  bool enter(Object& object) {
    if (object.epoch == epoch_) return false;
    adopt(object);
    return true;
  }
  /// Whether what `object` says of owners and waiters is of this run.
  bool has_entered(const Object& object) const { return object.epoch == epoch_; }
  /// Adds words to the digest of the running task's robot.
  void record_output(std::uint64_t name, std::uint64_t value);

  // --- what local clocks are made of ---

  /// A cost from `least` to `greatest` of the running task's computation, by the chooser, or the one recorded.
  Duration choose(Task& task, Duration least, Duration greatest);
  /// What is to count of a cost that does not follow from the run itself.
  Duration pass(const Task& task, Duration cost);
  /// The running task waits among those of `object` until it is woken, without an event of its own; false when the run
  /// is over.
  bool suspend(Object& object);

  // --- timers ---

  /// Puts a timer's event into the list, by default ahead of the tasks of that instant; `timer` has entered the run.
  void schedule(EventNode& node, Time time, const Object& timer, Phase phase = Phase::deliveries);
  void cancel(EventNode& node) { agenda_.events.remove(node); }

  // --- messages between robots ---

  /// Puts the arrival of a message of `sender` into the list, ahead of the tasks of that instant and behind its timers.
  /// Arrivals of one instant come in the order of (sender, how many messages it had sent), whenever they were put in.
  void deliver(EventNode& node, Time time, Robot& sender);
  /// Declares a link between robots on which nothing arrives sooner than `least` after it was sent; positive.
  void declare_latency(Duration least);
  /// The least latency of all links: what a robot does is noticed by no other sooner. Duration::max() without links.
  Duration lookahead() const { return lookahead_; }

  /// Events in the list: those of tasks that can go on or wait with a finite timeout, and those of timers.
  std::uint32_t pending_events() const { return agenda_.size(); }

  /// In the explored order, where tasks are ready: whether an event is due behind this instant, and in this window.
  bool is_due_later() const { return agenda_.is_due_later(); }
  /// When the next event is due; Time::max() if there is none.
  Time next_event_time() const;

  Time global_time() const { return agenda_.now; }
  Chooser& chooser() { return agenda_.chooser; }
  Task* first_task() const { return first_task_; }
  Robot* first_robot() const { return first_robot_; }
  /// Events executed so far, by tasks of all robots: a sum over these. Who wants it at each event counts them himself.
  std::uint64_t events() const;
  /// Times that a fiber was left for another.
  std::uint64_t switches() const { return switches_; }
  bool unwinding() const { return unwinding_; }
  /// Tasks that are left, and how many there may be at once: at most tasks_max.
  std::uint32_t tasks() const { return tasks_; }
  std::uint32_t most_tasks() const { return most_tasks_; }
  void set_most_tasks(std::uint32_t most) { most_tasks_ = most; }
  /// Tasks that are left and are no services.
  std::uint32_t live_tasks() const { return live_tasks_; }
  /// A task of the cycle in a deadlock, whose `search.to` leads around it, or one that spins; null without any.
  Task* culprit() const { return culprit_; }
  void set_watch(Watch* watch);
  /// Where the events of the task that ran last are hashed: its robot's digest.
  const PairDigest* lane_in_use() const { return lane_; }
  Watch* watch() const { return watch_; }
  /// What the layers above attach to the run.
  Hooks& hooks() { return hooks_; }
  const Hooks& hooks() const { return hooks_; }
  /// Sets or clears a bit of a task's attention.
  void attend(Task& task, std::uint8_t reason, bool needed);
  /// Writes the call stack of `task` (not running, started) to `frames`, at most `room`, innermost first; returns how
  /// many.
  std::size_t call_stack(Task& task, void** frames, std::size_t room);

 private:
  // Tasks: tasks.cpp.
  static void task_main(void* task);
  [[noreturn]] void end_task(Task& task);
  bool count_end(const Task& task);
  void unlink(Task& task);
  bool refuse();
  void reclaim_ended();
  static Task& task_of(EventNode& node) { return reinterpret_cast<Task&>(node); }  // the node is its first member

  // Algorithm 1, the plain path: waitpoint.cpp. What returns a fiber made its task the running one: it is to be entered
  // at once.
  bool announce(Task& task, Operation operation, Object* object);
  bool await_turn(Task& task);
  bool end_waitpoint(Task& task);
  bool end_segment(Task& task);
  bool begin_segment(Task& task, Operation operation, Object* object);
  Fiber& dispatch_instead_of(Task& task);
  Fiber& dispatch();
  Fiber& dispatch_explored();
  Fiber* dispatch_event(EventNode& node);
  Fiber& dispatch_task(Task& task);
  Fiber& resume(Task& task);
  void switch_fibers(Fiber& from, Fiber& to);
  Departure sleep_slow(Time time);
  bool give_turn(Task& task);
  void check_progress(Task& task);
  bool read_clock_slow(Task& task, Time& local);
  bool timer_waitpoint(Task& task, Operation operation, Object* object);
  void execute_start(Task& task);
  // The task's event is executed, and shown to the watch.
  [[gnu::always_inline]] void execute(Task& task, Operation operation, const Object* object) {
    count_event(task, operation, object, agenda_.now);
    if (__builtin_expect(watched_, 0)) show(operation, object);
  }
  void show(Operation operation, const Object* object);
  void hash_events_of(Robot& robot);
  void set_local_time(Task& task, Time time);

  // Algorithm 2: waiting.cpp.
  void adopt(Object& object);
  Departure block_slow(Object& object, Time deadline);
  Wake end_block_slow(Task& task, Object& object);
  Task* wake_one_slow(Object& object);
  void lend_priority(Task& task, Object& object);
  void reclaim_priority(Task& task, Object& object);
  void put(EventNode& node, const EventKey& key);
  bool is_deadlock(Task& task, const Object& object);

  // The run: run.cpp, explored.cpp, call_stack.cpp.
  void enter_run(Fiber& to);
  void exit_run(RunState state);
  Fiber& end_window(RunState state);
  Fiber& wait_for_window(Task& task);
  void let_time_pass();
  bool answer_interrupt();

  // The fast paths: fast_calls.cpp. A call that may leave its fiber comes in two parts, see departure.hpp.
  static Wake wake_of(const Departure& none) { return static_cast<Wake>(none.outcome()); }
  static Departure stay(Wake wake) { return Departure::none(static_cast<std::uintptr_t>(wake)); }
  void allow_fast_paths();
  // In which run's objects the running task may take the fast path: no watch looks on, and nothing is to be done first.
  std::uint64_t fast_epoch() const { return watched_ || interrupted_ || ended_ != nullptr ? Turn::no_epoch : epoch_; }
  bool can_exchange() const { return agenda_.present.empty() && fast_path_.is_enabled() && !agenda_.is_explored(); }
  Fiber& exchange_with_least(Task& task);
  bool waitpoint_at_present(Task& task, Operation operation, Object* object);
  Departure start_sleep(Time time);
  Departure depart_sleeping(Task& task);
  [[gnu::always_inline]] bool end_sleep(const Arrival& arrival) {
    note_where_left(arrival);
    Task& task = *running;
    if (!turn.is_fast()) return end_waitpoint(task);
    count_event(task, Operation::sleep, nullptr, turn.at);
    return true;
  }
  bool can_dispatch_present() const;
  template <bool is_finite>
  bool try_fast_wait(Task& task, Object& object, Time deadline);
  template <bool is_finite>
  Departure start_block(Object& object, Time deadline);
  [[gnu::always_inline]] Wake end_block(const Arrival& arrival, Object& object, bool is_finite) {
    note_where_left(arrival);
    Task& task = *running;
    if (!turn.is_fast()) return end_block_slow(task, object);
    const Wake wake = is_finite ? task.wake : Wake::woken;
    count_event(task, wake == Wake::woken ? Operation::resume : Operation::timeout, &object, turn.at);
    return wake;
  }
  bool departs(Fiber& from, Fiber& to);
  Task* wake_waiter(Object& object);

  // So many that are ready may be out of the cache.
  static constexpr std::uint32_t crowd_min = 32;

  Agenda agenda_;
  FastPath fast_path_;
  StackArena arena_;
  Fiber main_;
  Duration lookahead_ = Duration::max();
  Task* first_task_ = nullptr;
  Task* last_task_ = nullptr;
  Robot* first_robot_ = nullptr;
  Robot* last_robot_ = nullptr;
  Task* paused_ = nullptr;  // its event is the least, but not in this window
  Task* ended_ = nullptr;   // its stack is still underfoot until the next switch is done
  Task* culprit_ = nullptr;
  Task* first_abandoned_ = nullptr;
  Watch* watch_ = nullptr;
  bool watched_ = false;  // by a watch or a sanitizer
  Hooks hooks_;
  WaitGraph wait_graph_;
  std::uint64_t epoch_;
  std::uint64_t outputs_ = 0;  // hashed among the events
  std::uint64_t switches_ = 0;
  std::uint32_t live_tasks_ = 0;
  std::uint32_t tasks_ = 0;
  std::uint32_t made_ = 0;  // tasks so far
  std::uint32_t most_tasks_ = tasks_max;
  std::uint64_t turns_given_ = 0;  // since virtual time last moved
  Time turns_given_at_;
  RunState state_ = RunState::idle;
  StopCause cause_ = StopCause::none;
  PairDigest* lane_ = nullptr;      // as the turn has it, for who reads the scheduler from another process
  PairDigest ended_robots_digest_;  // of robots that ended
  bool fast_allowed_ = false;       // tasks may take the calls of fast_calls.cpp
  bool unwinding_ = false;
  bool interrupted_ =
      false;                 // tasks that get control are not to go on: they are unwound, or asked for their call stack
  void** frames_ = nullptr;  // where call_stack() wants them
  std::size_t frames_room_ = 0;
  std::size_t frames_found_ = 0;
};

}  // namespace waitpoint::kernel
