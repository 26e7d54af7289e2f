// SPDX-License-Identifier: BSD-3-Clause
// With many tasks, each one's record and stack are out of the cache by the time it is due: they are fetched while the
// ones before it run.
#pragma once

#include <cstddef>

#include "fibers/kernel/event_list.hpp"
#include "fibers/kernel/fetch.hpp"
#include "fibers/kernel/present_queue.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

// A parked task's registers, and the frames from its switch up to its own code; and below, where the kernel's frames
// will be when it parks again: to write to a line that is not there holds up all that is written after.
inline constexpr int stack_lines_above = 4, stack_lines_below = 3;
// Of a task's record, what waking it touches; of its robot's, where its events are hashed.
inline constexpr int record_lines_fetched = 4, robot_lines_fetched = 2;

inline void fetch_lines(const void* from, std::ptrdiff_t count) {
  for (std::ptrdiff_t line = 0; line < count; ++line) fetch(static_cast<const char*>(from) + 64 * line);
}

// Of the tasks that come next, in three steps, each of which reads what the one before it has fetched: the record; the
// stack, and what else the task works on; that. Any of them may be null.
inline void fetch_ahead(const Task* next, const Task* second, const Task* third) {
  if (third != nullptr) fetch_lines(third, record_lines_fetched);
  if (second != nullptr) {
    const char* const top = static_cast<const char*>(second->fiber.context);
    fetch_lines(top - 64 * stack_lines_below, stack_lines_below + stack_lines_above);
    fetch_lines(second->robot, robot_lines_fetched);
    const std::size_t listed = second->working_set_size * sizeof(CacheLines);
    fetch_lines(second->working_set, static_cast<std::ptrdiff_t>((listed + 63) / 64));
  }
  if (next == nullptr) return;
  for (std::uint32_t i = 0; i < next->working_set_size; ++i) {
    const CacheLines& lines = next->working_set[i];
    fetch_lines(reinterpret_cast<const void*>(lines.first * CacheLines::bytes), lines.count);
  }
}

/// Of those that are due next: so far ahead that memory has answered one step before the next asks for more. What comes
/// last may be no task: it is only fetched.
inline void fetch_coming(const EventList& events) {
  const auto as_task = [](const EventNode* node) {
    return node == nullptr || node->fire != nullptr ? nullptr : reinterpret_cast<const Task*>(node);
  };
  const EventNode* const last = events.coming(7);
  fetch_ahead(as_task(events.coming(1)), as_task(events.coming(4)), reinterpret_cast<const Task*>(last));
}

/// Of those that go on at the present instant; there must be one.
[[gnu::noinline]] inline void fetch_coming(const PresentQueue& present) {
  const Task* const next = present.first();
  const Task* const second = next->next_waiter;
  fetch_ahead(next, second, second != nullptr ? second->next_waiter : nullptr);
}

}  // namespace waitpoint::kernel
