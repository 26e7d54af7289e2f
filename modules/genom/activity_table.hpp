// SPDX-License-Identifier: BSD-3-Clause
// A module's table of activities. Guarded by the lock on the control data.
//
// Numbers are given in turn, so that the number of an ended activity is not soon reused. A bit mask of those in use is
// kept apart, and their tasks: every wake-up of every task looks for its own. An activity has two kilobytes, for its
// input and output: one that has ended is reused by the next, whatever its number, so that a module has as many as ran
// at once.
#pragma once

#include <array>
#include <bit>
#include <memory>
#include <utility>
#include <vector>

#include "modules/genom/activity.hpp"

namespace waitpoint::genom {

class ExecutionTask;

class ActivityTable {
  using Slot = std::unique_ptr<Activity>;

  template <class A>
  class Used {
   public:
    class Iterator {
     public:
      Iterator(const Slot* slots, std::uint32_t remaining) : slots_(slots), remaining_(remaining) {}
      A& operator*() const { return *slots_[std::countr_zero(remaining_)]; }
      Iterator& operator++() {
        remaining_ &= remaining_ - 1;
        return *this;
      }
      bool operator==(const Iterator& other) const { return remaining_ == other.remaining_; }

     private:
      const Slot* slots_;
      std::uint32_t remaining_;
    };
    Used(const Slot* slots, std::uint32_t used) : slots_(slots), used_(used) {}
    Iterator begin() const { return {slots_, used_}; }
    Iterator end() const { return {slots_, 0}; }

   private:
    const Slot* slots_;
    std::uint32_t used_;
  };

 public:
  /// The activities, by number; the current element of an iteration may be freed.
  Used<Activity> used() { return {slots_.data(), used_}; }
  Used<const Activity> used() const { return {slots_.data(), used_}; }
  /// Those of one execution task.
  Used<Activity> used_of(const ExecutionTask& task) {
    std::uint32_t own = 0;
    for (std::uint32_t remaining = used_; remaining != 0; remaining &= remaining - 1)
      if (task_[static_cast<std::size_t>(std::countr_zero(remaining))] == &task) own |= remaining & -remaining;
    return {slots_.data(), own};
  }
  bool empty() const { return used_ == 0; }

  bool full() const { return used_ == all; }
  /// Allocates an activity of `task` and gives it a number. Not while the table is full.
  Activity& add(const ExecutionTask& task) {
    while ((used_ >> next_ & 1) != 0) next_ = (next_ + 1) % activities_max;
    if (spare_.empty()) spare_.push_back(std::make_unique<Activity>());
    slots_[next_] = std::move(spare_.back());
    spare_.pop_back();
    Activity& added = *slots_[next_];
    added.number = static_cast<std::int32_t>(next_);
    task_[next_] = &task;
    used_ |= 1U << next_;
    next_ = (next_ + 1) % activities_max;
    return added;
  }
  void free(Activity& activity) {
    const std::int32_t number = activity.number;
    used_ &= ~(1U << number);
    activity = Activity();
    spare_.push_back(std::move(slots_[static_cast<std::size_t>(number)]));
  }

  static constexpr bool is_number(std::int32_t number) {
    return number >= 0 && number < static_cast<std::int32_t>(activities_max);
  }
  /// Null if no activity has this number.
  Activity* find(std::int32_t number) {
    return (used_ >> number & 1) != 0 ? slots_[static_cast<std::size_t>(number)].get() : nullptr;
  }

 private:
  static constexpr std::uint32_t all = (1U << activities_max) - 1;

  std::uint32_t used_ = 0;  // one bit per slot
  std::size_t next_ = 0;
  std::array<const ExecutionTask*, activities_max> task_{};  // by number
  std::array<Slot, activities_max> slots_;                   // by number
  std::vector<Slot> spare_;
};

}  // namespace waitpoint::genom
