// SPDX-License-Identifier: BSD-3-Clause
// With many tasks, each one's record and stack are out of the cache at its next turn: they are prefetched during the
// turns before.
#pragma once

#include <cstddef>

#include "fibers/kernel/event_list.hpp"
#include "fibers/kernel/fetch.hpp"
#include "fibers/kernel/present_queue.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

// Above: a parked task's registers, and the frames from its switch up to its own code. Below: the place of the kernel's
// frames when it parks again; a write that misses the cache delays all later writes.
inline constexpr std::ptrdiff_t stack_lines_above = 4, stack_lines_below = 3;
// The lines of a task's record that waking it touches, and those of its robot's digest.
inline constexpr int record_lines_fetched = 4, robot_lines_fetched = 2;

inline void fetch_lines(const void* from, std::ptrdiff_t count) {
  for (std::ptrdiff_t line = 0; line < count; ++line) fetch(static_cast<const char*>(from) + 64 * line);
}

inline void fetch_lines(const CacheLines& lines) {
  fetch_lines(reinterpret_cast<const void*>(lines.first * CacheLines::bytes), lines.count);
}

// Prefetches for the next three tasks, any of which may be null. A task passes through three steps, each of which reads
// the lines that the previous step has fetched: its record; its stack, robot and list of working set; its working set.
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
  for (std::uint32_t i = 0; i < next->working_set_size; ++i) fetch_lines(next->working_set[i]);
}

/// Prefetches for events of the list. The distances between the steps exceed the latency of memory. The last node may
/// not be a task's: it is fetched, not read.
inline void fetch_coming(const EventList& events) {
  const auto as_task = [](const EventNode* node) {
    return node == nullptr || node->fire != nullptr ? nullptr : reinterpret_cast<const Task*>(node);
  };
  const EventNode* const last = events.coming(7);
  fetch_ahead(as_task(events.coming(1)), as_task(events.coming(4)), reinterpret_cast<const Task*>(last));
}

/// Prefetches for tasks of the present queue, which must not be empty.
[[gnu::noinline]] inline void fetch_coming(const PresentQueue& present) {
  const Task* const next = present.first();
  const Task* const second = next->next_waiter;
  fetch_ahead(next, second, second != nullptr ? second->next_waiter : nullptr);
}

}  // namespace waitpoint::kernel
