// SPDX-License-Identifier: BSD-3-Clause
// Measurements of a campaign's first schedule, which is in the default order: its length, and the events of each task
// with their objects. Strategies use them as estimates.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fibers/explore/strategies/memory_option.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/watch.hpp"

namespace waitpoint::exploration {

struct Profile {
  struct TaskEvents {
    std::uint64_t task;    ///< its id: the same in every schedule
    std::uint64_t parent;  ///< 0 for the first task
    std::uint32_t events = 0;
    std::vector<std::uint64_t> objects;  ///< identity of each event's object, in order; 0: none
  };

  std::uint32_t steps = 0;     ///< switch points
  Memory memory = Memory::sc;  ///< of instrumented code
  std::vector<TaskEvents> tasks;
  std::vector<std::uint64_t> shared;  ///< identities of objects that more than one task used
  std::vector<std::uint64_t> code;    ///< of another process: code addresses that access shared memory

  /// Completes the profile; the run had `switch_points`.
  void finish(std::uint32_t switch_points);
  /// Null for a task not in the first schedule.
  const TaskEvents* find(std::uint64_t task) const {
    for (const TaskEvents& known : tasks)
      if (known.task == task) return &known;
    return nullptr;
  }
  TaskEvents* find(std::uint64_t task) { return const_cast<TaskEvents*>(std::as_const(*this).find(task)); }
};

/// Records the events of one run, as its scheduler's watch. Afterwards the profile must be finished.
class Profiling : public kernel::Watch {
 public:
  explicit Profiling(Profile& profile);

 private:
  static void count(kernel::Watch& self, const kernel::EventRecord& record);

  Profile& profile_;
};

}  // namespace waitpoint::exploration
