// SPDX-License-Identifier: BSD-3-Clause
// All pending events in their order: the event list, and at its head the events of the present instant.
//
//   fifo      present | events       at the present instant an event is its robot's last: no search for its place
//   seeded              events       each tie is a hash
//   explored  ready   | events       a strategy chooses among the ready tasks
//
// In all orders, events of one instant are sorted by phase first.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/chooser.hpp"
#include "fibers/kernel/event_list.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/present_queue.hpp"
#include "fibers/kernel/ready_set.hpp"

namespace waitpoint::kernel {

struct Agenda {
  EventList events{events_max};
  PresentQueue present;
  ReadySet ready;
  Chooser chooser;
  Time now;    ///< the time of the event now executing
  Time until;  ///< the end of the window: only events before it are executed

  Agenda(Order order, std::uint64_t seed) : chooser(order, seed) {}

  /// Reinitialises with this seed; must be empty.
  void restart(std::uint64_t seed) {
    events.restart();
    chooser.restart(seed);
    now = until = Time();
  }
  /// Removes all events.
  void clear() {
    while (!events.empty()) events.pop();
    ready.clear();
    present.clear();
  }

  bool is_explored() const { return chooser.order() == Order::explored; }
  std::uint32_t size() const { return events.size() + ready.size() + present.size(); }

  EventKey key(const Task& task, Time time) { return {time, make_order(task.phase, chooser.tie(task))}; }

  /// Places the task's event at `time`.
  void place(Task& task, Time time) {
    if (time <= now) {
      if (chooser.order() == Order::fifo && PresentQueue::is_for(task.phase)) return place_present(task);
      if (is_explored() && task.phase == Phase::tasks) return ready.add(task);
    }
    events.insert(task.event, key(task, time));
  }
  /// Places it at the present instant; in the first-in-first-out order, for a phase of the present queue.
  void place_present(Task& task) {
    const std::uint64_t order = make_order(task.phase, chooser.tie_of_next(task));
    if (__builtin_expect(!present.try_add(task, order), 0)) events.insert(task.event, {now, order});
  }
  /// Places the timeout of a blocked task, which is mostly removed before it is due.
  void place_timeout(Task& task, Time time) {
    if (__builtin_expect(is_explored(), 0)) return place(task, time);
    events.insert(task.event, key(task, time));
  }
  /// Removes the task's event, if it has one.
  void remove(Task& task) {
    if (task.event.place == EventNode::ready)
      is_explored() ? ready.remove(task) : present.remove(task);
    else if (task.event.in_list())
      events.remove(task.event);
  }

  /// The key of the least event; EventKey::never() if there is none.
  EventKey next_key() const {
    const EventKey& least = events.least().key;
    if (present.empty()) return least;
    const EventKey first{now, present.order()};
    return first < least ? first : least;
  }
  Time next_time() const { return ready.empty() ? next_key().time : now; }
  /// True if the least event of the list is after this instant and in this window.
  bool is_due_later() const {
    return !events.empty() && now < events.least().key.time && events.least().key.time < until;
  }

  /// True if the present queue's first event is the least one, and in this window.
  bool is_present_next() const {
    return !present.empty() && now < until && !(events.least().key < EventKey{now, present.order()});
  }
  /// True if `task`, at a waitpoint, continues without a switch: its event is the least. Never in the explored order,
  /// where the strategy chooses.
  bool is_next(const Task& task) { return __builtin_expect(!is_explored(), 1) && precedes(task, next_key()); }
  /// Advances the global time to `time` without taking an event; no event may be due before.
  void advance(Time time) {
    now = time;
    events.advance(time);
  }

  /// True if the task's event, which is not in the list, sorts before `other`.
  bool precedes(const Task& task, const EventKey& other) {
    if (task.local_time != other.time) return task.local_time < other.time;
    return key_in_turn(task).order <= other.order;
  }
  /// The key of the event of a task that is not in the list.
  EventKey key_in_turn(const Task& task) {
    // First-in-first-out: at the present instant a task continues although others tie with it. At a later time it sorts
    // behind its ties, as an inserted event would: otherwise the order would depend on unrelated events in between.
    const std::uint64_t tie = chooser.order() == Order::seeded ? chooser.tie(task)
                              : task.local_time == now         ? 0
                                                               : Chooser::last_tie(task);
    return {task.local_time, make_order(task.phase, tie)};
  }
};

}  // namespace waitpoint::kernel
