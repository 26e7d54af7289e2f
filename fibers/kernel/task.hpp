// SPDX-License-Identifier: BSD-3-Clause
// The kernel's records, as plain structs that a debugger can read: tasks, robots, and objects.
//
// A task is a fiber with a local virtual time. It is in exactly one of three states: running; ready, with its event in
// the event list; or blocked on an object, with an event at its timeout if that is finite.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "core/working_set.hpp"
#include "fibers/kernel/event_list.hpp"
#include "fibers/kernel/footprint.hpp"
#include "fibers/kernel/operation.hpp"
#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Durations;
struct LocalClock;
struct Seat;
struct Task;

inline constexpr std::size_t name_size = 48;
/// Copies a name, as much of it as there is room for; null: none.
void copy_name(char (&to)[name_size], const char* from);

/// A robot as the kernel sees it: the unit of the digest. Tasks of no robot belong to one named "environment".
struct Robot {
  char name[name_size] = {};
  Robot* next = nullptr;
  Scheduler* scheduler = nullptr;
  PairDigest digest;                    ///< of its own events and outputs, until its end
  PairDigest* digest_in_use = nullptr;  ///< the digest that takes in its tasks' events: `digest`, until its end
  std::uint64_t id = 0;                 ///< a hash of its name
  std::uint32_t number = 0;             ///< counts the run's robots, from 0
  std::uint32_t place = 0;              ///< among the robots at each instant, in the first-in-first-out order
  std::uint64_t messages = 0;           ///< number sent to other robots
  std::uint64_t outputs = 0;            ///< number of its tasks' outputs, hashed beside the events
  std::uint32_t objects = 0;            ///< number of objects numbered so far
  std::uint32_t children = 0;           ///< number of tasks spawned from outside any task
  std::uint32_t live_tasks = 0;         ///< number of tasks that are not services
  bool ended = false;                   ///< live_tasks fell to 0: the digest is frozen
  Time end_time;
  void* client = nullptr;  ///< the robot's object in the layer above
};

/// The part of a primitive that the kernel knows: identity, owners and waiters.
struct Object {
  explicit constexpr Object(const char* kind_of, const char* label_of = "")
      : kind(kind_of), label(label_of != nullptr ? label_of : "") {}
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  // The members that every use touches come first: one cache line of an aligned object.
  std::uint64_t epoch = 0;      ///< the run that the other members belong to
  std::uint64_t identity = 0;   ///< a hash of robot and number, for the digest
  Task* owner = nullptr;        ///< the holder, of an object with at most one
  Object* next_held = nullptr;  ///< the object that the owner took before this one
  Task* first_waiter = nullptr;
  Task* last_waiter = nullptr;
  std::uint32_t users = 0;   ///< number of tasks in a call that blocks on it: waiting, or woken and still returning
  std::uint32_t number = 0;  ///< at first use in a run, counted per robot

  const char* kind;
  const char* label;
  Robot* robot = nullptr;          ///< the robot that counted it
  Task* const* holders = nullptr;  ///< the holders, of an object with several
  std::uint32_t holder_count = 0;
};

enum class TaskState : std::uint8_t {
  ready,  ///< its event is in the list, at its local virtual time
  running,
  blocked,  ///< on an object; with a finite timeout its event is in the list too
  ended,
};

/// The reason why a block ended.
enum class Wake : std::uint8_t {
  woken,
  timed_out,
  unwinding,  ///< the run is over: the caller must leave its frames without blocking again
};

/// The bits of Task::attention: reasons for extra work at a task's waitpoints, which excludes the fast path.
namespace attention {
inline constexpr std::uint8_t clock = 1;      ///< it has a local clock, which measures its segments
inline constexpr std::uint8_t signal = 2;     ///< a signal is pending
inline constexpr std::uint8_t timer = 4;      ///< not a task, but the record that stands for timers, which cannot block
inline constexpr std::uint8_t processor = 8;  ///< it shares a processor
}  // namespace attention

/// A task's state in the search for cycles of the wait-for graph: see wait_graph.cpp.
struct WaitSearch {
  std::uint64_t number = 0;  ///< the search that the other members belong to
  Task* from = nullptr;      ///< the predecessor on the path: it waits for this task
  Task* to = nullptr;        ///< the successor on the path: this task waits for it
  std::uint32_t tried = 0;   ///< number of successors visited
  bool on_path = false;
};

/// What a task executes, for reports, in two texts that outlive it: {"codel exec", "Blink"}. Null: nothing declared.
struct Work {
  const char* what = nullptr;
  const char* of = "";
};

struct Task {
  // The members that every event touches, in the first two cache lines. The event comes first: a node's address is its
  // task's.
  EventNode event;
  Time local_time;
  Robot* robot = nullptr;
  std::uint64_t id = 0;          ///< a hash of the robot and the path of creation
  std::uint64_t sequence = 0;    ///< number of events so far
  Object* at = nullptr;          ///< the object of its last waitpoint, if any
  std::uint32_t waitpoints = 0;  ///< number of waitpoints passed at its local time
  Phase phase = Phase::tasks;
  Operation operation = Operation::start;
  Wake wake = Wake::woken;
  TaskState state = TaskState::ready;
  bool finite_wait = false;  ///< blocked with a finite timeout
  std::uint8_t attention = 0;
  bool service = false;      ///< does not keep the run alive
  bool shared_wait = false;  ///< blocked for shared ownership of the object
  Fiber fiber;

  Object* blocked_on = nullptr;
  Object* held = nullptr;                   ///< the object it took last, linked to the others by Object::next_held
  const CacheLines* working_set = nullptr;  ///< the memory it touches whenever it runs, if declared
  std::uint32_t working_set_size = 0;
  Task* next_waiter = nullptr;  // or the next in the present queue (present_queue.hpp)
  Task* previous_waiter = nullptr;
  std::uint64_t queue_order = 0;  // the place of its event at the instant of that queue
  Scheduler* scheduler = nullptr;
  Task* next = nullptr;  // intrusive list of the run's tasks, in the order of their making
  Task* previous = nullptr;
  void (*entry)(void*) = nullptr;
  void* argument = nullptr;
  LocalClock* clock = nullptr;  ///< null: only declared costs advance its local time
  Seat* seat = nullptr;         ///< on a shared processor; null: a processor of its own
  std::uint64_t choices = 0;    ///< number of its computing times chosen so far
  std::uint32_t children = 0;
  std::uint64_t maker = 0;        ///< the id of the task that made it; 0: from outside
  std::uint64_t made_after = 0;   ///< number of events of its maker before
  std::uint32_t number = 0;       ///< counts the run's tasks in the order of their making, from 0
  std::uint32_t held_shared = 0;  ///< number of its entries in lists of holders
  std::uint32_t refusals = 0;     ///< number of calls refused since the run is over
  EventFootprint
      footprint{};  ///< of its pending event, beside the object; set by who announces it, until it is executed
  WaitSearch search;
  Work work{};
  char name[name_size] = {};
};

/// The task whose code this thread executes; null outside of tasks. The thread's own, as is `turn` (turn.hpp): a
/// simulation stays on the thread that runs its tasks, and others run on other threads. In the static block of
/// thread-local storage, which every thread has at the same distance from its thread pointer: an access is no call.
[[gnu::tls_model("initial-exec")]] extern constinit thread_local Task* running;

}  // namespace waitpoint::kernel
