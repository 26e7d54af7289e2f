// SPDX-License-Identifier: BSD-3-Clause
// A module's table of activities. Guarded by the lock on the control data.
//
// Slots are allocated in turn, so that the number of an ended activity is not soon reused. A bit mask of the slots in
// use is kept apart: a slot has two kilobytes, and every wake-up of every task iterates over those in use.
#pragma once

#include <bit>
#include <vector>

#include "modules/genom/activity.hpp"

namespace waitpoint::genom {

class ActivityTable {
  template <class A>
  class Used {
   public:
    class Iterator {
     public:
      Iterator(A* slots, std::uint32_t left) : slots_(slots), left_(left) {}
      A& operator*() const { return slots_[std::countr_zero(left_)]; }
      Iterator& operator++() {
        left_ &= left_ - 1;
        return *this;
      }
      bool operator==(const Iterator& other) const { return left_ == other.left_; }

     private:
      A* slots_;
      std::uint32_t left_;
    };
    Used(A* slots, std::uint32_t used) : slots_(slots), used_(used) {}
    Iterator begin() const { return {slots_, used_}; }
    Iterator end() const { return {slots_, 0}; }

   private:
    A* slots_;
    std::uint32_t used_;
  };

 public:
  /// The activities, by number; the current element of an iteration may be freed.
  Used<Activity> used() { return {slots_.data(), used_}; }
  Used<const Activity> used() const { return {slots_.data(), used_}; }
  bool empty() const { return used_ == 0; }

  bool full() const { return used_ == all; }
  /// Allocates an activity and gives it a number. Not while the table is full.
  Activity& add() {
    while ((used_ >> next_ & 1) != 0) next_ = (next_ + 1) % activities_max;
    Activity& added = slots_[next_];
    added.number = static_cast<std::int32_t>(next_);
    used_ |= 1U << next_;
    next_ = (next_ + 1) % activities_max;
    return added;
  }
  void free(Activity& activity) {
    used_ &= ~(1U << activity.number);
    activity = Activity();
  }

  static constexpr bool is_number(std::int32_t number) {
    return number >= 0 && number < static_cast<std::int32_t>(activities_max);
  }
  /// Null if no activity has this number.
  Activity* find(std::int32_t number) {
    return (used_ >> number & 1) != 0 ? &slots_[static_cast<std::size_t>(number)] : nullptr;
  }

 private:
  static constexpr std::uint32_t all = (1U << activities_max) - 1;

  std::uint32_t used_ = 0;  // one bit per slot
  std::size_t next_ = 0;
  // On the heap: the module's other members, which many tasks touch at every wake-up, then share few pages.
  std::vector<Activity> slots_ = std::vector<Activity>(activities_max);
};

}  // namespace waitpoint::genom
