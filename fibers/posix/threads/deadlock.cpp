// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/threads/deadlock.hpp"

#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/thread.hpp"
#include "fibers/posix/threads/thread_states.hpp"
#include "fibers/posix/timers/signal_timer.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t line_max = 1024;

// A ready thread, a deadline, a timer, or what is outside of the process: one of these may yet end the program, or the
// process. Where none does, the run ends as soon as nothing is left to happen.
bool can_others_go_on(const kernel::Scheduler& scheduler) {
  return anybody_waits_outside() || family::has_others() || kernel::pending_events(scheduler) > 0;
}

}  // namespace

void report_end(const kernel::Scheduler& scheduler, const char* why) {
  char line[line_max];
  if (family::family == nullptr || !std::exchange(family::family->is_reported, true)) {
    BoundedText text(line, sizeof line);
    text.add("waitpoint: %s at ", why);
    add_time(text, kernel::global_time(scheduler));
    text.add("\n");
    text.write();
  }
  for (const kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next) {
    WAITPOINT_CHECK(is_thread(*task), "a task is reported that is no thread");
    BoundedText text(line, sizeof line);
    add_state(text, *task);
    text.write();
  }
}

bool continues_after_cycle(kernel::Task& task) {
  if (!is_thread(task)) return false;
  if (SignalTimer::any_is_set()) return true;
  const kernel::Scheduler& scheduler = *task.scheduler;
  if (has_host || record->settings.asked != nullptr || !can_others_go_on(scheduler)) return false;
  const ErrorNumberKept kept;
  char line[line_max];
  {
    BoundedText text(line, sizeof line);
    text.add("waitpoint: deadlock at ");
    add_time(text, kernel::global_time(scheduler));
    text.add(", of some threads; the others continue\n");
    text.write();
  }
  const kernel::Task* const first = kernel::culprit(scheduler);
  const kernel::Task* of_cycle = first;
  do {
    WAITPOINT_CHECK(of_cycle != nullptr && of_cycle->blocked_on != nullptr, "a cycle of waiting threads is open");
    BoundedText text(line, sizeof line);
    add_state(text, *of_cycle);
    text.write();
    of_cycle = of_cycle->search.to;
  } while (of_cycle != first);
  return true;
}

}  // namespace waitpoint::posix
