// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/processor_timers.hpp"

#include "core/error.hpp"
#include "fibers/posix/program/computing_watch.hpp"

namespace waitpoint::posix {

ProcessorTimer* first_processor_timer = nullptr;

void set_processor_timer(ProcessorTimer& timer, const Duration& spent, Duration due) {
  WAITPOINT_CHECK(timer.ring != nullptr, "a processor timer has no function to call");
  unset_processor_timer(timer);
  timer.spent = &spent;
  timer.due = due;
  timer.next = first_processor_timer;
  first_processor_timer = &timer;
  if (expect_computing != nullptr) expect_computing();
}

void unset_processor_timer(ProcessorTimer& timer) {
  ProcessorTimer** link = &first_processor_timer;
  while (*link != nullptr && *link != &timer) link = &(*link)->next;
  WAITPOINT_CHECK((*link == &timer) == (timer.spent != nullptr),
                  "a processor timer is in the list, but not set, or not");
  if (*link == &timer) *link = timer.next;
  timer.spent = nullptr;
}

void unset_processor_timers_of(const Duration& spent) {
  for (ProcessorTimer *timer = first_processor_timer, *next = nullptr; timer != nullptr; timer = next) {
    next = timer->next;
    if (timer->spent == &spent) unset_processor_timer(*timer);
  }
}

void look_at_processor_timers() {
  for (ProcessorTimer *timer = first_processor_timer, *next = nullptr; timer != nullptr; timer = next) {
    next = timer->next;
    WAITPOINT_CHECK(timer->spent != nullptr, "a processor timer in the list is not set");
    if (*timer->spent < timer->due) continue;
    const Duration& spent = *timer->spent;
    unset_processor_timer(*timer);
    timer->ring(*timer, spent);
  }
}

}  // namespace waitpoint::posix
