// SPDX-License-Identifier: BSD-3-Clause
// The tasks whose events were put in for the present instant: the head of the event list, where the order is
// first-in-first-out.
//
// Such an event goes behind all of its instant and phase that were put in before, so that it needs no search for its
// place; and most events are such: a task is woken by another, or gives way to those that tie with it. The queue has
// those of the world's phase in front, then those of the tasks'. In the list there may be earlier ones of this instant,
// which its least key tells.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class PresentQueue {
 public:
  /// Whether tasks run in that phase.
  static bool is_for(Phase phase) { return phase == Phase::tasks || phase == Phase::world; }

  bool empty() const { return first_ == nullptr; }
  std::uint32_t size() const { return size_; }
  /// The first, and from there on by Task::next_waiter the others; null if there is none.
  const Task* first() const { return first_; }
  /// The place of the first among the events of its instant; there must be one.
  std::uint64_t order() const { return make_order(first_->phase, first_->queue_tie); }

  /// `task`, of such a phase, must be neither here nor in the event list, and come behind all of its phase
  /// that are here.
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
  /// Takes out the first; there must be one.
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
  Task* last_ = nullptr;  // while there is a first
  Task* last_of_world_ = nullptr;
  std::uint32_t size_ = 0;
};

}  // namespace waitpoint::kernel
