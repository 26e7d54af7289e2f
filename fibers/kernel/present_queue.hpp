// SPDX-License-Identifier: BSD-3-Clause
// The queue of events inserted at the present instant, at the head of the event list in the first-in-first-out order.
//
// Such an event sorts behind all earlier insertions of its robot, instant and phase. Most events are of this kind: a
// task is woken by another of its robot, or yields. Since the robots run one after the other, its place is at the end
// (one robot, or the last one), or near the head (the robot that runs): no search. An event with a far place goes to
// the event list. Events of the world's phase come first in the queue, then those of the tasks' phase.
//
// The event list may hold earlier events of this instant; compare with its least key.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class PresentQueue {
 public:
  /// True if events of that phase may be in the queue.
  static bool is_for(Phase phase) { return phase == Phase::tasks || phase == Phase::world; }

  bool empty() const { return first_ == nullptr; }
  std::uint32_t size() const { return size_; }
  /// The first task, linked to the others by Task::next_waiter; null if the queue is empty.
  const Task* first() const { return first_; }
  /// The first event's place at its instant; the queue must not be empty.
  std::uint64_t order() const { return first_->queue_order; }

  /// `task` must be of such a phase, and neither here nor in the event list; `order` is its event's place. False, with
  /// nothing changed, if that is far from both ends.
  [[nodiscard]] bool try_add(Task& task, std::uint64_t order) {
    WAITPOINT_CHECK(!task.event.in_list(), "a task becomes ready twice");
    if (__builtin_expect(first_ == nullptr, 1))
      first_ = &task;
    else if (__builtin_expect(last_->queue_order < order, 1))
      last_->next_waiter = &task;
    else
      return try_add_near_head(task, order);
    task.next_waiter = nullptr;
    last_ = &task;
    note_added(task, order);
    return true;
  }
  /// Takes out the first task; the queue must not be empty.
  Task& take() {
    Task& task = *first_;
    first_ = task.next_waiter;
    task.event.place = EventNode::absent;
    --size_;
    return task;
  }
  /// Takes out `task`, which must be here.
  void remove(Task& task) {
    Task* before = nullptr;
    for (Task* other = first_; other != &task; other = other->next_waiter) before = other;
    (before == nullptr ? first_ : before->next_waiter) = task.next_waiter;
    if (last_ == &task) last_ = before;
    task.event.place = EventNode::absent;
    --size_;
  }
  void clear() {
    while (!empty()) take();
  }

 private:
  static constexpr int reach = 16;  // greatest number of events that an insertion near the head passes

  [[gnu::noinline]] bool try_add_near_head(Task& task, std::uint64_t order) {
    Task** link = &first_;
    for (int passed = 0; *link != nullptr && (*link)->queue_order < order; ++passed) {
      if (passed == reach) return false;
      link = &(*link)->next_waiter;
    }
    if (*link == nullptr) last_ = &task;
    task.next_waiter = *link;
    *link = &task;
    note_added(task, order);
    return true;
  }
  void note_added(Task& task, std::uint64_t order) {
    task.event.place = EventNode::ready;
    task.queue_order = order;
    ++size_;
  }

  Task* first_ = nullptr;
  Task* last_ = nullptr;  // valid unless the queue is empty
  std::uint32_t size_ = 0;
};

}  // namespace waitpoint::kernel
