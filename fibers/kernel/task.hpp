// SPDX-License-Identifier: BSD-3-Clause
// The kernel's records, as plain structs that a debugger can read: tasks, the robots they belong to, the objects they
// meet at.
//
// A task is a fiber with a local virtual time. It is running, or has its event in the event list, or is blocked on an
// object (with, for a finite timeout, its event at the timeout): there is no other place for it to be.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "core/working_set.hpp"
#include "fibers/kernel/event_list.hpp"
#include "fibers/kernel/operation.hpp"
#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Durations;
struct LocalClock;
struct Seat;
struct Task;

inline constexpr std::size_t name_size = 48;

/// A robot as the kernel sees it: the unit of the digest. Tasks of no robot belong to one named "environment".
struct Robot {
  char name[name_size] = {};
  Robot* next = nullptr;
  Scheduler* scheduler = nullptr;
  PairDigest digest;             ///< of its own events and outputs, until it ended
  PairDigest* lane = nullptr;    ///< where its tasks' events are hashed: `digest`, until it ended
  std::uint64_t id = 0;          ///< from its name
  std::uint64_t messages = 0;    ///< sent to other robots
  std::uint32_t objects = 0;     ///< numbers given to objects
  std::uint32_t children = 0;    ///< tasks spawned from outside any task
  std::uint32_t live_tasks = 0;  ///< that are no services
  bool ended = false;            ///< its last such task ended: the digest is frozen
  Time end_time;
  void* client = nullptr;  ///< what the layer above hangs on the robot
};

/// What tasks wait for and meet at: part of every primitive.
struct Object {
  explicit constexpr Object(const char* kind_of, const char* label_of = "")
      : kind(kind_of), label(label_of != nullptr ? label_of : "") {}
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  // What every use touches comes first: of an object that begins with a cache line it is one.
  std::uint64_t epoch = 0;      ///< of the run that the rest belongs to
  std::uint64_t identity = 0;   ///< of robot and number: what the digest takes in
  Task* owner = nullptr;        ///< who holds it, where one can hold it
  Object* next_held = nullptr;  ///< of what its owner holds, what it took before
  Task* first_waiter = nullptr;
  Task* last_waiter = nullptr;
  std::uint32_t users = 0;   ///< tasks within a call that blocks on it: those that wait, and those on their way out
  std::uint32_t number = 0;  ///< at first use in a run, counted per robot

  const char* kind;
  const char* label;
  Robot* robot = nullptr;          ///< whose count that is
  Task* const* holders = nullptr;  ///< who holds it, where several can
  std::uint32_t holder_count = 0;
};

enum class TaskState : std::uint8_t {
  ready,  ///< its event is in the list, at its local virtual time
  running,
  blocked,  ///< on an object; with a finite timeout its event is in the list too
  ended,
};

/// Why a blocked task goes on.
enum class Wake : std::uint8_t {
  woken,
  timed_out,
  unwinding,  ///< the run is over: leave all frames without blocking again
};

/// Why the waitpoints of a task take the slow way: the bits of Task::attention. Without any they do not.
namespace attention {
inline constexpr std::uint8_t clock = 1;      ///< it has a local clock: what its segments cost is not declared alone
inline constexpr std::uint8_t signal = 2;     ///< a signal is to be delivered
inline constexpr std::uint8_t timer = 4;      ///< it is no task: timers act in its name, between tasks, and cannot wait
inline constexpr std::uint8_t processor = 8;  ///< it shares a processor
}  // namespace attention

/// A task's place in the search for a cycle of tasks that wait for each other: see wait_graph.cpp.
struct WaitSearch {
  std::uint64_t number = 0;  ///< of the search that the rest belongs to
  Task* from = nullptr;      ///< who waits for this task
  Task* to = nullptr;        ///< for whom it waits
  std::uint32_t tried = 0;   ///< of those for whom it waits
  bool on_path = false;
};

struct Task {
  // What every event touches, in the first two cache lines. The event comes first: an event's node is its task.
  EventNode event;
  Time local_time;
  Robot* robot = nullptr;
  std::uint64_t id = 0;        ///< from robot and creation path
  std::uint64_t sequence = 0;  ///< its events so far
  Object* at = nullptr;        ///< the object of its last waitpoint, if any
  std::uint32_t turns = 0;     ///< waitpoints passed at its local time
  Phase phase = Phase::tasks;
  Operation operation = Operation::start;
  Wake wake = Wake::woken;
  TaskState state = TaskState::ready;
  bool finite_wait = false;  ///< blocked with a finite timeout
  std::uint8_t attention = 0;
  bool service = false;      ///< does not keep the run alive
  bool shared_wait = false;  ///< blocked where it would hold the object together with others
  bool describe = false;     ///< asked to write down its own call stack and to switch back
  Fiber fiber;

  Object* blocked_on = nullptr;
  Object* held = nullptr;                   ///< what it owns: the latest, then by Object::next_held
  const CacheLines* working_set = nullptr;  ///< what it touches whenever it runs, if it has said so
  std::uint32_t working_set_size = 0;
  Task* next_waiter = nullptr;  // or, of those that are ready at the present instant, see present_queue.hpp
  Task* previous_waiter = nullptr;
  std::uint64_t queue_tie = 0;  // its event's, while it is in that queue
  Scheduler* scheduler = nullptr;
  Task* next = nullptr;  // all tasks of the run in the order of their making, in an intrusive list
  Task* previous = nullptr;
  void (*entry)(void*) = nullptr;
  void* argument = nullptr;
  LocalClock* clock = nullptr;  ///< null: only what it declares moves its local time
  Seat* seat = nullptr;         ///< null: it has a processor of its own
  std::uint64_t choices = 0;    ///< its computing times that were chosen so far
  std::uint32_t children = 0;
  std::uint64_t maker = 0;        ///< the id of the task that made it; 0: from outside
  std::uint32_t number = 0;       ///< of the run's tasks, in the order of their making, from 0
  std::uint32_t held_shared = 0;  ///< how often it stands among the holders of something
  std::uint32_t refusals = 0;     ///< calls made since the run is over
  WaitSearch search;
  char name[name_size] = {};
};

/// The task whose code is executing, or null outside any. With its turn (turn.hpp) the only global.
extern Task* running;

}  // namespace waitpoint::kernel
