// SPDX-License-Identifier: BSD-3-Clause
// A hash of the happens-before relation of a schedule, its Mazurkiewicz trace: equal for schedules that differ only in
// the order of independent events, so that schedules with nothing new can be counted.
//
// The hash of an event depends on its task's event before it and, by dependence.hpp, on those at its object that it
// does not commute with; the trace's is their sum. An object is known by its first event, since its number depends on
// the order of all objects. Where independence is uncertain (yields, signals, waits, timers, channels) an event depends
// on all before it: then equivalent schedules may count as different, but never the reverse.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fibers/explore/strategies/dependence.hpp"
#include "fibers/kernel/decisions.hpp"

namespace waitpoint::exploration {

class TraceHash {
 public:
  void clear();
  /// The pending event of `task` is next.
  void add(const kernel::Task& task);
  /// `task` takes this alternative of a choice that is not between tasks.
  void add(kernel::Choice choice, const kernel::Task& task, std::uint32_t chosen);

  std::uint64_t value() const { return Digest::mix(sum_); }

 private:
  struct ObjectState {
    std::uint64_t change = 0;  // the last event that changed it; at first what the object is known by
    std::uint64_t looks = 0;   // the sum of the events since that only read it
  };

  std::uint64_t& last_of(const kernel::Task& task);
  static bool depends_on_all(const kernel::Task& task);

  std::vector<std::uint64_t> last_;                         // by Task::number: its last event
  std::unordered_map<std::uint64_t, ObjectState> objects_;  // by identity
  std::uint64_t barrier_ = 0;                               // the last event that depends on all before it
  std::uint64_t sum_ = 0;
};

}  // namespace waitpoint::exploration
