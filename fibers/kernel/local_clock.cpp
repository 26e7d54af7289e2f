// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/local_clock.hpp"

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {

void set_clock(Task& task, LocalClock* clock) {
  WAITPOINT_CHECK(&task != running, "a task's local clock is changed while it runs");
  task.clock = clock;
  task.attention = static_cast<std::uint8_t>(clock != nullptr ? task.attention | attention::clock
                                                              : task.attention & ~attention::clock);
}

Time local_time_by_clock(Task& task) {
  LocalClock* clock = task.clock;
  if (clock != nullptr && clock->end != nullptr) {
    clock->end(*clock, task);
    if (clock->begin != nullptr) clock->begin(*clock, task);
  }
  return task.local_time;
}

void compute(Task& task, Duration least, Duration greatest) {
  WAITPOINT_CHECK(least >= Duration(), "computing takes no negative time");
  WAITPOINT_CHECK(least <= greatest, "the ends of an interval of computing times are swapped");
  if (task.clock != nullptr) {
    if (task.clock->compute != nullptr) task.clock->compute(*task.clock, task, least, greatest);
  } else {
    task.local_time += greatest;
  }
}

void Scheduler::end_segment(Task& task) {
  if (task.clock != nullptr && task.clock->end != nullptr) task.clock->end(*task.clock, task);
}

// The task goes on with `operation`, unless a signal comes first: what its handler does takes time, and the operation
// has its place in the order of time after that.
bool Scheduler::begin_segment(Task& task, Operation operation, Object* object) {
  while ((task.attention & attention::signal) != 0) {
    task.attention = static_cast<std::uint8_t>(task.attention & ~attention::signal);
    if (task.clock != nullptr && task.clock->begin != nullptr) task.clock->begin(*task.clock, task);
    WAITPOINT_CHECK(deliver_ != nullptr, "a signal is pending, and nobody delivers it");
    deliver_(task);
    if (unwinding_) return false;
    end_segment(task);
    task.operation = operation;
    task.at = object;
    if (!arrive_after_signal(task)) return false;
  }
  if (task.clock != nullptr && task.clock->begin != nullptr) task.clock->begin(*task.clock, task);
  return true;
}

}  // namespace waitpoint::kernel
