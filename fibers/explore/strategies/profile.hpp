// SPDX-License-Identifier: BSD-3-Clause
// What the first schedule of a campaign, which is first in first out, showed of the body: how long it is, how many
// events each of its tasks has, and at which objects. Strategies that need to know beforehand take it as an estimate.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::exploration {

struct Profile {
  struct TaskEvents {
    std::uint64_t task;    ///< its id: the same in every schedule
    std::uint64_t parent;  ///< 0 for the first task
    std::uint32_t events = 0;
    std::vector<std::uint64_t> objects;  ///< of each event, 0 without one: their identities, in their order
  };

  std::uint32_t steps = 0;  ///< switch points
  std::vector<TaskEvents> tasks;
  std::vector<std::uint64_t> shared;  ///< identities of objects that more than one task used
  std::vector<std::uint64_t> code;    ///< of another process: addresses where code accesses memory that tasks share

  /// With the events of all tasks: the run had so many switch points.
  void finish(std::uint32_t switch_points);
  /// Null for a task that the first schedule did not have.
  const TaskEvents* find(std::uint64_t task) const {
    for (const TaskEvents& known : tasks)
      if (known.task == task) return &known;
    return nullptr;
  }
  TaskEvents* find(std::uint64_t task) { return const_cast<TaskEvents*>(std::as_const(*this).find(task)); }
};

/// Counts the events of one run, as its scheduler's watch. When it is over the profile is to be finished.
class Profiling : public kernel::Watch {
 public:
  explicit Profiling(Profile& profile);

 private:
  static void count(kernel::Watch& self, const kernel::EventRecord& record);

  Profile& profile_;
};

}  // namespace waitpoint::exploration
