// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/processor_timers.hpp"

namespace waitpoint::posix {

ProcessorTimer* first_processor_timer = nullptr;

void set_processor_timer(ProcessorTimer& timer, const Duration& spent, Duration due) {
  unset_processor_timer(timer);
  timer.spent = &spent;
  timer.due = due;
  timer.next = first_processor_timer;
  first_processor_timer = &timer;
}

void unset_processor_timer(ProcessorTimer& timer) {
  for (ProcessorTimer** link = &first_processor_timer; *link != nullptr; link = &(*link)->next)
    if (*link == &timer) {
      *link = timer.next;
      break;
    }
  timer.spent = nullptr;
}

void look_at_processor_timers() {
  for (ProcessorTimer *timer = first_processor_timer, *next = nullptr; timer != nullptr; timer = next) {
    next = timer->next;
    if (*timer->spent < timer->due) continue;
    const Duration& spent = *timer->spent;
    unset_processor_timer(*timer);
    timer->ring(*timer, spent);
  }
}

}  // namespace waitpoint::posix
