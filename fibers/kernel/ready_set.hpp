// SPDX-License-Identifier: BSD-3-Clause
// The ready tasks of the present instant, in the order of their becoming ready, for a strategy to choose among: the
// head of the event list in the explored order.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class ReadySet {
 public:
  ReadySet() = default;
  ~ReadySet();
  ReadySet(const ReadySet&) = delete;
  ReadySet& operator=(const ReadySet&) = delete;

  /// Reserves address space for `capacity` tasks; memory is committed as it is used. To be called once, before add().
  void reserve(std::uint32_t capacity);

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }
  Task* const* tasks() const { return tasks_; }
  static bool contains(const Task& task) { return task.event.place == EventNode::ready; }

  /// `task` must not be in this set or the event list.
  void add(Task& task) {
    WAITPOINT_CHECK(!task.event.in_list(), "a task becomes ready twice");
    task.event.place = EventNode::ready;
    tasks_[size_++] = &task;
  }
  /// Takes out the task at index `at`.
  Task& take(std::uint32_t at) {
    WAITPOINT_CHECK(at < size_, "a task was chosen that is not ready");
    Task& task = *tasks_[at];
    task.event.place = EventNode::absent;
    for (--size_; at < size_; ++at) tasks_[at] = tasks_[at + 1];
    return task;
  }
  /// Takes out `task`, which must be here.
  void remove(const Task& task) {
    std::uint32_t at = 0;
    while (tasks_[at] != &task) ++at;
    take(at);
  }
  void clear() {
    while (size_ > 0) take(size_ - 1);
  }

 private:
  Task** tasks_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint32_t capacity_ = 0;
};

}  // namespace waitpoint::kernel
