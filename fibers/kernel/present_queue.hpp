// SPDX-License-Identifier: BSD-3-Clause
// The queue of events inserted at the present instant, at the head of the event list in the first-in-first-out order.
//
// Such an event sorts behind all earlier insertions of its instant and phase, so it needs no search for its place. Most
// events are of this kind: a task is woken by another, or yields. Events of the world's phase come first in the queue,
// then those of the tasks' phase. The event list may hold earlier events of this instant; compare with its least key.
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
  std::uint64_t order() const { return make_order(first_->phase, first_->queue_tie); }

  /// `task` must be of such a phase, neither here nor in the event list, and sort behind all events of its phase here.
  void add(Task& task, std::uint64_t tie) {
    WAITPOINT_CHECK(!task.event.in_list(), "a task becomes ready twice");
    task.event.place = EventNode::ready;
    task.queue_tie = tie;
    ++size_;
    if (__builtin_expect(task.phase == Phase::world, 0)) return add_of_world(task);
    task.next_waiter = nullptr;
    if (__builtin_expect(first_ == nullptr, 1))
      first_ = &task;
    else
      last_->next_waiter = &task;
    last_ = &task;
  }
  /// Takes out the first task; the queue must not be empty.
  Task& take() {
    Task& task = *first_;
    first_ = task.next_waiter;
    if (__builtin_expect(last_of_world_ == &task, 0)) last_of_world_ = nullptr;
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
    if (last_of_world_ == &task) last_of_world_ = before;
    task.event.place = EventNode::absent;
    --size_;
  }
  void clear() {
    while (!empty()) take();
  }

 private:
  void add_of_world(Task& task) {
    Task*& link = last_of_world_ == nullptr ? first_ : last_of_world_->next_waiter;
    task.next_waiter = link;
    link = &task;
    last_of_world_ = &task;
    if (task.next_waiter == nullptr) last_ = &task;
  }

  Task* first_ = nullptr;
  Task* last_ = nullptr;  // valid unless the queue is empty
  Task* last_of_world_ = nullptr;
  std::uint32_t size_ = 0;
};

}  // namespace waitpoint::kernel
