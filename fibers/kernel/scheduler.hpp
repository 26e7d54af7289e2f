// SPDX-License-Identifier: BSD-3-Clause
// The scheduler is the event list (the paper's Algorithms 1 and 2).
//
// Every primitive begins with waitpoint(): the task's event is in the list at its local virtual time, and the task
// continues when that event is the least. The global time is the time of the event now executing; it never decreases.
// So all uses of primitives happen in the order of virtual time, regardless of the computation in between.
//
// Hand-over is direct, from the fiber that cannot continue to the fiber of the least event. A task whose own event is
// the least does not switch. The context that called run_before(), the main fiber, is re-entered only when the run
// stops.
//
// The plain path is waitpoint.cpp and waiting.cpp; fast_path.hpp and fast_calls.cpp are short cuts to the same events.
//
// The scheduler throws nothing, prints nothing, and allocates nothing while running.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/agenda.hpp"
#include "fibers/kernel/fast_path.hpp"
#include "fibers/kernel/hooks.hpp"
#include "fibers/kernel/roster.hpp"
#include "fibers/kernel/run_state.hpp"
#include "fibers/kernel/spawn_options.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/wait_graph.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/switch/departure.hpp"
#include "fibers/switch/reserved_pages.hpp"
#include "fibers/switch/stack_arena.hpp"

namespace waitpoint::kernel {

struct Visit;

class Scheduler {
 public:
  Scheduler(Order order, std::uint64_t seed);
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// True if there is enough address space to construct a scheduler (ulimit -v).
  static bool has_address_space() { return !kept_pages().empty() || EventList::has_address_space(events_max); }

  /// Reserves the address space of a scheduler of the explored order, which the next one in this process, or in a
  /// forked one, gets: as it would have reserved it.
  static void reserve_ahead();

  /// Sets the strategy of the explored order, before the first run_before(). It must outlive the run.
  void set_decisions(Decisions& decisions);

  /// Before the first task: enables or disables the short cuts (default: enabled). The run is the same without them.
  void use_fast_paths(bool used);

  /// After unwind(): the state of a new scheduler of this seed, without robots; its memory is kept. Takes a
  /// microsecond.
  void restart(std::uint64_t seed);

  /// Adds a robot; the record must outlive the run.
  void add(Robot& robot, const char* name) { roster_.add(robot, name, *this); }

  /// Makes a task of `robot` that starts at the caller's local time (outside of tasks: at the global time). Null if
  /// the roster is full or no stack is free.
  Task* spawn(Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument);

  /// Executes all events before `until`. A run stays on the thread of its first call; other runs may be on others.
  RunState run_before(Time until);
  StopCause stop_cause() const { return cause_; }
  /// After a stop because no task but services remained: the next run_before() executes their events.
  void go_on_after_end();
  /// Stops the run from within a task; run_before() returns at once.
  void stop(StopCause cause);
  /// The same from a timer or a watch: no further event is executed.
  void stop_between_events(StopCause cause, Task& culprit);
  /// From a task or a watch: run_before() returns before another event is executed, as if its window ended here. The
  /// next call continues the run as if there had been no pause.
  void pause();

  /// Ends the run: unwinds every remaining task, whose blocking calls return Wake::unwinding. The youngest task goes
  /// first, since a task may refer to the frames of its maker.
  void unwind();
  /// Ends `task`, which must not be the running one, without unwinding it; its objects become unowned. Its stack is
  /// kept for free_stack().
  void end_in_place(Task& task);
  /// Frees the stack of a task that was ended in place, and its record with it.
  void free_stack(const Task& task) { arena_.give_back(Stack(task.fiber.stack)); }
  /// Ends the running task, which has passed the waitpoint of its end, without unwinding it.
  [[noreturn]] void end_running_task();
  /// Abandons the running task, which cannot or does not leave its frames while it is unwound: their resources leak.
  [[noreturn]] void abandon();

  // --- the parts of primitives; only within a task ---

  /// The running task's event is at its local time; returns when it is the least. False if the run is over.
  bool waitpoint(Operation operation, Object* object);
  /// The plain path, for callers that have tried the fast path.
  bool waitpoint_slow(Operation operation, Object* object);
  /// Reads the running task's clock. Not an event; but a read counts towards waitpoints_max, so that a task that polls
  /// its clock yields to its ties. False if the run is over.
  bool read_clock(Time& local);
  /// To be called when the running task's local time leaves the present instant.
  void close_fast_path() { fast_path_.close(); }
  /// A waitpoint behind all tasks of this instant; in the seeded order, at a hashed place among them.
  bool yield();
  /// A waitpoint at `time`, or at the local time if that is later. False if the run is over.
  bool sleep_until(Time time);
  /// Blocks the running task on `object` until it is woken or until `deadline`; Time::max(): no timeout.
  Wake block(Object& object, Time deadline);
  /// Wakes one waiter of `object`, selected by the chooser; null if there is none. The waiter's local time becomes the
  /// global time.
  Task* wake_one(Object& object);
  void wake_all(Object& object);
  /// Wakes `task`, which must be blocked: for primitives that select the waiter themselves.
  void wake(Task& task);
  /// Moves `task`, which must be blocked, to the waiters of `to`; its timeout is kept. Neither object may be held.
  void move_waiter(Task& task, Object& to);
  /// Wakes the first waiter, without a choice: for timers, which are not tasks.
  Task* wake_first(Object& object);
  /// Makes `object` belong to this run. True if it did not yet: the primitive must then take its initial state.
  bool enter(Object& object);
  /// Makes `object` belong to this run as the `number`-th object of `robot`, whose tasks are in another process.
  void adopt_as(Object& object, Robot& robot, std::uint32_t number);
  /// True if the owners and waiters in `object` belong to this run.
  bool has_entered(const Object& object) const { return object.epoch == epoch_; }
  /// Adds words to the digest of the running task's robot.
  void record_output(std::uint64_t name, std::uint64_t value);

  /// Blocks the running task on `object` until it is woken, without executing an event: for shared processors. False if
  /// the run is over.
  bool suspend(Object& object);

  // --- timers ---

  /// Inserts a timer's event, by default ahead of the tasks of that instant. `timer` must have entered the run.
  void schedule(EventNode& node, Time time, const Object& timer, Phase phase = Phase::deliveries);
  void cancel(EventNode& node) { agenda_.events.remove(node); }

  // --- one of several runs whose events have one common order: the processes of a program (posix/family) ---

  /// Inserts a timer's event with a key of another run's.
  void schedule(EventNode& node, const EventKey& key);
  /// The key of the least event; EventKey::never() if there is none.
  EventKey next_key();
  /// Outside of tasks: moves the global time forward, before the next event.
  void advance(Time time);
  /// After a fork, in the child: the running task, the only one, continues with this id. Its robot's id and digest may
  /// have been replaced.
  void continue_as(std::uint64_t id);

  // --- messages between robots ---

  /// Inserts the arrival of a message of `sender`, ahead of the tasks of that instant and behind its timers. Arrivals
  /// at one instant are ordered by {sender, its count of messages}, regardless of the order of insertion.
  void deliver(EventNode& node, Time time, Robot& sender);
  /// The same for a message that was sent, and counted, in another process.
  void deliver(EventNode& node, Time time, const Robot& sender, std::uint64_t count);
  /// Declares a link between robots with a latency of at least `least`, which must be positive.
  void declare_latency(Duration least);
  /// The least latency of all links: no robot can affect another within it. Duration::max() without links.
  Duration lookahead() const { return lookahead_; }

  /// The number of pending events: of ready tasks, finite timeouts, timers and messages.
  std::uint32_t pending_events() const { return agenda_.size(); }

  /// In the explored order, while tasks are ready: true if an event is due after this instant and within this window.
  bool is_due_later() const { return agenda_.is_due_later(); }
  /// The time of the next event; Time::max() if there is none.
  Time next_event_time() const;

  Time global_time() const { return agenda_.now; }
  Chooser& chooser() { return agenda_.chooser; }
  Roster& roster() { return roster_; }
  const Roster& roster() const { return roster_; }
  Task* first_task() const { return roster_.first_task(); }
  /// The number of events executed so far: a sum over all robots, too slow to be called at each event.
  std::uint64_t events() const { return roster_.events(); }
  /// The number of switches between fibers.
  std::uint64_t switches() const { return switches_; }
  bool unwinding() const { return unwinding_; }
  /// In a deadlock, a task of the cycle (`search.to` links its members); without progress, a spinning task; else null.
  Task* culprit() const { return culprit_; }
  /// The number of waitpoints at one instant after which a run ends without progress although tasks exchange something.
  void set_instant_limit(std::uint64_t waitpoints) { instant_limit_ = waitpoints; }
  /// True if the present instant has passed that limit.
  bool is_beyond_instant_limit() const { return waitpoints_at_instant_ > instant_limit_; }
  void set_watch(Watch* watch);
  /// The digest that takes in the events of the task that ran last: its robot's.
  const PairDigest* digest_in_use() const { return digest_in_use_; }
  Watch* watch() const { return watch_; }
  /// The attachments of the layers above.
  Hooks& hooks() { return hooks_; }
  const Hooks& hooks() const { return hooks_; }
  /// Sets or clears a bit of a task's attention.
  void attend(Task& task, std::uint8_t reason, bool needed);
  /// From outside of tasks: resumes `task`, which must have started, outside of virtual time. It calls `visit.act` on
  /// top of its stack and is parked again.
  void visit(Task& task, Visit& visit);

 private:
  // Tasks: tasks.cpp.
  static void task_main(void* task);
  [[noreturn]] void end_task(Task& task);
  bool refuse();
  void reclaim_ended();
  static Task& task_of(EventNode& node) { return reinterpret_cast<Task&>(node); }  // the node is its first member

  // Algorithm 1, the plain path: waitpoint.cpp, its inline steps in scheduler_steps.hpp, and explored.cpp. A function
  // that returns a fiber has made its task the running one: the caller must switch to it at once.
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
  bool yield_after(std::uint32_t waitpoints);
  bool yield_to_ties(Task& task);
  void check_progress(Task& task, std::uint32_t waitpoints);
  bool read_clock_slow(Task& task, Time& local);
  bool timer_waitpoint(Task& task, Operation operation, Object* object);
  void execute_start(Task& task);
  void execute(Task& task, Operation operation, const Object* object);
  void show(Operation operation, const Object* object);
  void hash_events_of(Robot& robot);
  void set_local_time(Task& task, Time time);

  // Algorithm 2: waiting.cpp; put() in scheduler_steps.hpp.
  void adopt(Object& object);
  Departure block_slow(Object& object, Time deadline);
  Wake end_block_slow(Task& task, Object& object);
  Task* wake_one_slow(Object& object);
  void put(EventNode& node, const EventKey& key);
  bool is_deadlock(Task& task, const Object& object);

  // The run: run.cpp, explored.cpp, visit.cpp; enter_run() in scheduler_steps.hpp.
  void stay_on_thread();
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
  // The epoch of the objects that the running task may use by the fast path: none while a watch or other work is
  // pending.
  std::uint64_t fast_epoch() const { return watched_ || interrupted_ || ended_ != nullptr ? Turn::no_epoch : epoch_; }
  bool can_exchange() const { return agenda_.present.empty() && fast_path_.is_enabled() && !agenda_.is_explored(); }
  Fiber& exchange_with_least(Task& task);
  bool waitpoint_at_present(Task& task, Operation operation, Object* object);
  Departure start_sleep(Time time);
  Departure depart_sleeping(Task& task);
  bool end_sleep(const Arrival& arrival);
  bool can_dispatch_present() const;
  Departure leave_for_present(Task& task, Object& object, bool has_timeout);
  Departure block_with_far_timeout(Object& object, EventKey timeout);
  template <bool is_finite>
  Departure start_block(Object& object, Time deadline);
  Wake end_block(const Arrival& arrival, Object& object, bool is_finite);
  bool departs(Fiber& from, Fiber& to);
  Task* wake_here(Object& object);
  Task* wake_waiter(Object& object);
  Task* wake_from_far_timeout(Object& object);

  // From this number of ready tasks on, their memory may be out of the cache.
  static constexpr std::uint32_t crowd_min = 32;

  Agenda agenda_;
  FastPath fast_path_;
  StackArena arena_;
  Fiber main_;
  const void* thread_ = nullptr;  // that runs the tasks, by its thread pointer; null before the first
  Duration lookahead_ = Duration::max();
  Task* paused_ = nullptr;  // its event is the least, but beyond this window
  Task* ended_ = nullptr;   // its stack is in use until the next switch is done
  Task* culprit_ = nullptr;
  Watch* watch_ = nullptr;
  bool watched_ = false;  // by a watch, a debugger or a sanitizer
  Hooks hooks_;
  WaitGraph wait_graph_;
  std::uint64_t epoch_;
  std::uint64_t switches_ = 0;
  std::uint64_t idle_yields_ = 0;            // since virtual time last moved, or a task took what another one gave
  std::uint64_t waitpoints_at_instant_ = 0;  // since virtual time last moved; counted at yields
  std::uint64_t instant_limit_ = instant_limit;
  Time yields_at_;
  RunState state_ = RunState::idle;
  StopCause cause_ = StopCause::none;
  PairDigest* digest_in_use_ =
      nullptr;                 // equal to turn.digest, for debuggers that read the scheduler from another process
  bool fast_allowed_ = false;  // tasks may take the calls of fast_calls.cpp
  bool unwinding_ = false;
  bool interrupted_ = false;  // resumed tasks do not continue: they unwind, or are visited
  Visit* visit_ = nullptr;    // of the task that is resumed next
  Roster roster_;
};

// --- the inline parts of calls ---

inline bool Scheduler::waitpoint(Operation operation, Object* object) {
  if (object != nullptr && try_fast_waitpoint(operation, *object)) return true;
  return waitpoint_slow(operation, object);
}

inline bool Scheduler::read_clock(Time& local) {
  Task& task = *running;
  if (__builtin_expect(!fast_path_.holds_for(task), 0)) return read_clock_slow(task, local);
  ++task.waitpoints;
  local = task.local_time;
  return true;
}

[[gnu::always_inline]] inline void Scheduler::execute(Task& task, Operation operation, const Object* object) {
  count_event(task, operation, object, agenda_.now);
  if (__builtin_expect(watched_, 0)) show(operation, object);
}

[[gnu::always_inline]] inline bool Scheduler::sleep_until(Time time) {
  const Departure away = start_sleep(time);
  return away.leads_away() ? end_sleep(depart(away)) : wake_of(away) != Wake::unwinding;
}

[[gnu::always_inline]] inline bool Scheduler::end_sleep(const Arrival& arrival) {
  note_where_left(arrival);
  Task& task = *running;
  if (!turn.is_fast()) return end_waitpoint(task);
  count_event(task, Operation::sleep, nullptr, turn.at);
  return true;
}

[[gnu::always_inline]] inline Wake Scheduler::block(Object& object, Time deadline) {
  // Two instances, since the deadline is mostly a constant: the compiler chooses one, and no test is left.
  const bool is_finite = deadline != Time::max();
  const Departure away = is_finite ? start_block<true>(object, deadline) : start_block<false>(object, deadline);
  return away.leads_away() ? end_block(depart(away), object, is_finite) : wake_of(away);
}

[[gnu::always_inline]] inline Wake Scheduler::end_block(const Arrival& arrival, Object& object, bool is_finite) {
  note_where_left(arrival);
  Task& task = *running;
  if (!turn.is_fast()) return end_block_slow(task, object);
  const Wake wake = is_finite ? task.wake : Wake::woken;
  count_event(task, wake == Wake::woken ? Operation::resume : Operation::timeout, &object, turn.at);
  return wake;
}

inline Task* Scheduler::wake_one(Object& object) {
  return object.first_waiter == nullptr ? nullptr : wake_waiter(object);
}

inline bool Scheduler::enter(Object& object) {
  if (object.epoch == epoch_) return false;
  adopt(object);
  return true;
}

}  // namespace waitpoint::kernel
