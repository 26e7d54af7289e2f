// SPDX-License-Identifier: BSD-3-Clause
// The tasks whose events were put in for the present instant: the head of the event list, where the order is
// first-in-first-out.
//
// Such an event goes behind all of its instant and phase that were put in before, so that it needs no search for its
// place; and most events are such: a task is woken by another, or gives way to those that tie with it. There is a queue
// for each of the phases in which tasks run, the world's first. In the list there may be earlier ones of this instant,
// which its least key tells.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class PresentQueue {
 public:
  /// Whether tasks run in that phase.
  static bool is_for(Phase phase) { return phase == Phase::tasks || phase == Phase::world; }

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }
  /// The first, and from there on by Task::next_waiter those of its phase; null if there is none.
  const Task* first() const { return first_of_all().first; }
  /// The place of the first among the events of its instant; there must be one.
  std::uint64_t order() const { return first()->queue_order; }

  /// `task`, of such a phase, must be neither here nor in the event list, and come behind all of its phase
  /// that are here.
  void add(Task& task, std::uint64_t order) {
    WAITPOINT_CHECK(!task.event.in_list(), "a task becomes ready twice");
    task.event.place = EventNode::ready;
    task.queue_order = order;
    task.next_waiter = nullptr;
    Queue& queue = queue_of(task);
    (queue.first == nullptr ? queue.first : queue.last->next_waiter) = &task;
    queue.last = &task;
    ++size_;
  }
  /// Takes out the first; there must be one.
  Task& take() {
    Queue& queue = first_of_all();
    Task& task = *queue.first;
    queue.first = task.next_waiter;
    task.event.place = EventNode::absent;
    --size_;
    return task;
  }
  /// Takes out `task`, which must be here.
  void remove(Task& task) {
    Queue& queue = queue_of(task);
    Task* before = nullptr;
    for (Task* other = queue.first; other != &task; other = other->next_waiter) before = other;
    (before == nullptr ? queue.first : before->next_waiter) = task.next_waiter;
    if (queue.last == &task) queue.last = before;
    task.event.place = EventNode::absent;
    --size_;
  }
  void clear() {
    while (!empty()) take();
  }

 private:
  struct Queue {
    Task* first = nullptr;
    Task* last = nullptr;
  };
  Queue& queue_of(const Task& task) { return task.phase == Phase::world ? world_ : tasks_; }
  Queue& first_of_all() { return world_.first != nullptr ? world_ : tasks_; }
  const Queue& first_of_all() const { return world_.first != nullptr ? world_ : tasks_; }

  Queue world_, tasks_;
  std::uint32_t size_ = 0;
};

}  // namespace waitpoint::kernel
