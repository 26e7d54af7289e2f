// SPDX-License-Identifier: BSD-3-Clause
// The abstract state of a run at a switch point: the pending event of each ready task, and whether its object has been
// changed by others since the task's own last event there. So few states stand for many runs, and those in which a task
// is about to act on what it has read before, though others have changed it, are told apart.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class AbstractState {
 public:
  /// Begins another run.
  void clear();
  /// A hash of the state before this switch point; equal for equal states of all runs.
  std::uint64_t at(const SwitchPoint& point);
  /// The pending event of `task` is next.
  void note(const Task& task);

 private:
  struct LastEvent {
    std::uint32_t task;     // its number
    std::uint32_t changes;  // of the object up to its last event there
  };
  struct Used {
    std::uint64_t run = 0;  // the run that the other members belong to
    std::uint32_t changes = 0;
    std::vector<LastEvent> last_events;

    LastEvent* of(const Task& task);
  };
  struct Pending {
    std::uint64_t run = 0, sequence = 0;  // the event that the other members belong to
    std::uint64_t hash = 0;
    const Used* object = nullptr;
    std::uint32_t changes = 0;  // of the object up to the task's last event there
  };

  Used& used(std::uint64_t object);
  const Pending& pending(const Task& task);

  std::uint64_t run_ = 0;
  std::unordered_map<std::uint64_t, Used> objects_;  // by identity
  std::vector<Pending> pending_;                     // by Task::number
};

}  // namespace waitpoint::exploration
