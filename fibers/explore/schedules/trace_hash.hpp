// SPDX-License-Identifier: BSD-3-Clause
// A hash of the happens-before relation of a schedule, its Mazurkiewicz trace: equal for schedules that differ only in
// the order of independent events, so that schedules with nothing new can be counted.
//
// The hash of an event depends on its time, on its task's event before it and on those, at its object and the places of
// dependence.hpp, that it does not commute with; the trace's is the sum of all. Objects need no names, which depend on
// the order of all objects: what a task uses follows from its events before.
#pragma once

#include <cstdint>
#include <vector>

#include "fibers/explore/strategies/dependence.hpp"
#include "fibers/explore/strategies/object_table.hpp"
#include "fibers/kernel/decisions.hpp"

namespace waitpoint::exploration {

class TraceHash {
 public:
  /// `memory`: the dependences are those of this memory model.
  explicit TraceHash(Memory memory) : memory_(memory) {}

  void clear();
  /// The pending event of `task` is next, at the time `now`.
  void add(const kernel::Task& task, Time now);
  /// `task` takes this alternative of a choice that is not between tasks.
  void add(kernel::Choice choice, const kernel::Task& task, std::uint32_t chosen);

  std::uint64_t value() const { return Digest::mix(sum_); }

 private:
  /// The state of an object or a place, as far as the order of events has made it.
  struct State {
    std::uint64_t change = 0;  // the last event that changed it
    std::uint64_t looks = 0;   // the sum of the events since that only read it

    std::uint64_t seen_by(std::uint64_t event, bool changes) const;
    void take(std::uint64_t event, bool changes);
  };

  std::uint64_t& last_of(const kernel::Task& task);

  Memory memory_;
  std::vector<std::uint64_t> last_;  // by Task::number: its last event
  ObjectTable<State> objects_;
  State places_[place::count];  // of place::run only the change, since all events read it
  std::uint64_t sum_ = 0;
};

}  // namespace waitpoint::exploration
