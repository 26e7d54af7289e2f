// SPDX-License-Identifier: BSD-3-Clause
// What is due, and in which order: the event list, and in front of it what is due at the present instant.
//
//   fifo      present | events       those put in at this instant need no search for their place: they are the last
//   seeded              events       each tie is a hash
//   explored  ready   | events       of those that are ready somebody else chooses
//
// A task of an earlier phase comes first in all of them.
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
  Time until;  ///< where the window ends: no event from there on is executed

  Agenda(Order order, std::uint64_t seed) : chooser(order, seed) {}

  /// As new, of this seed; it must be empty.
  void restart(std::uint64_t seed) {
    events.restart();
    chooser.restart(seed);
    now = until = Time();
  }
  /// Whatever was due is not any more.
  void clear() {
    while (!events.empty()) events.pop();
    clear_present();
  }
  void clear_present() {
    ready.clear();
    present.clear();
  }

  bool is_explored() const { return chooser.order() == Order::explored; }
  std::uint32_t size() const { return events.size() + ready.size() + present.size(); }

  EventKey key(const Task& task, Time time) { return {time, make_order(task.phase, chooser.tie(task))}; }

  /// The task's event at `time`.
  void place(Task& task, Time time) {
    if (time <= now) {
      if (chooser.order() == Order::fifo && PresentQueue::is_for(task.phase))
        return present.add(task, chooser.tie(task));
      if (is_explored() && task.phase == Phase::tasks) return ready.add(task);
    }
    events.insert(task.event, key(task, time));
  }
  /// The same, of a task that waits until then at the longest, and may be taken out again.
  void place_timeout(Task& task, Time time) {
    if (__builtin_expect(is_explored(), 0)) return place(task, time);
    events.insert(task.event, key(task, time));
  }
  /// The task's event, wherever it is; it may have none.
  void remove(Task& task) {
    if (task.event.place == EventNode::ready)
      is_explored() ? ready.remove(task) : present.remove(task);
    else if (task.event.in_list())
      events.remove(task.event);
  }

  /// Of the least event; never due if there is none.
  EventKey next_key() const {
    const EventKey& least = events.least().key;
    if (present.empty()) return least;
    const EventKey first{now, present.order()};
    return first < least ? first : least;
  }
  Time next_time() const { return ready.empty() ? next_key().time : now; }
  /// Whether an event of the list is due in this window.
  bool is_due_later() const { return !events.empty() && events.least().key.time < until; }

  /// Whether the present queue's first event is the least, and in this window.
  bool is_present_next() const {
    return !present.empty() && now < until && !(events.least().key < EventKey{now, present.order()});
  }
  /// Whether the event of a task at its own waitpoint is the least: it goes on then. In the explored order that is
  /// chosen.
  bool is_next(const Task& task) { return __builtin_expect(!is_explored(), 1) && precedes(task, next_key()); }
  /// Time comes to `time` without an event out of the list; none in it is due before.
  void advance(Time time) {
    now = time;
    events.advance(time);
  }

  /// Whether the task's event, were it in the list, would come before `other`.
  bool precedes(const Task& task, const EventKey& other) {
    if (task.local_time != other.time) return task.local_time < other.time;
    // First-in-first-out: at the present instant a task goes on although others tie with it. One whose time has moved
    // on comes behind them, as through the list: else it would depend on unrelated events in between.
    const std::uint64_t tie = chooser.order() == Order::seeded ? chooser.tie(task)
                              : task.local_time == now         ? 0
                                                               : tie_mask;
    return make_order(task.phase, tie) <= other.order;
  }
};

}  // namespace waitpoint::kernel
