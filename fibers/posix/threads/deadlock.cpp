// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/threads/deadlock.hpp"

#include <cstdio>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/symbols.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/thread.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/timers/signal_timer.hpp"

namespace waitpoint::posix {
namespace {

// "main", or "reader: main" if there are several programs.
void print_name(const kernel::Task& task) {
  const bool is_one_of_several = family::family != nullptr && family::family->made > 1;
  if (is_thread(task) && (thread_of(task).program->is_member || is_one_of_several))
    std::fprintf(stderr, "%s: ", task.robot->name);
  std::fprintf(stderr, "%s", task.name);
}

// "mutex jobs_lock", or the address if the program has no symbol for it.
void print_object(const kernel::Object& object) {
  const Waitable* const waitable = waitable_of(object);
  if (waitable == nullptr) {
    std::fprintf(stderr, "%s", std::strcmp(object.kind, "thread") == 0 ? "the end of a thread" : object.kind);
    return;
  }
  std::fprintf(stderr, "%s ", object.kind);
  if (const char* const name = symbol_at(waitable->address); name != nullptr)
    std::fprintf(stderr, "%s", name);
  else
    std::fprintf(stderr, "at %p", waitable->address);
}

void print_time(const kernel::Scheduler& scheduler) {
  constexpr long long second_ns = 1'000'000'000;
  const long long now_ns = scheduler.global_time().ns();
  std::fprintf(stderr, "%lld.%09lld s of virtual time", now_ns / second_ns, now_ns % second_ns);
}

// A line with the object that the task waits for, and its holder.
void print_wait(const kernel::Task& task) {
  std::fprintf(stderr, "  ");
  print_name(task);
  if (task.blocked_on == nullptr) {
    std::fprintf(stderr, " is ready");
  } else {
    std::fprintf(stderr, " waits for ");
    print_object(*task.blocked_on);
    if (const kernel::Task* owner = task.blocked_on->owner; owner != nullptr) {
      const bool is_end = std::strcmp(task.blocked_on->kind, "thread") == 0;
      std::fprintf(stderr, ", %s ", is_end ? "that is" : "held by");
      owner == &task ? static_cast<void>(std::fprintf(stderr, "itself")) : print_name(*owner);
    }
  }
  std::fprintf(stderr, "\n");
}

bool can_others_go_on(const kernel::Scheduler& scheduler) {
  if (anybody_waits_outside()) return true;
  for (const kernel::Task* task = scheduler.first_task(); task != nullptr; task = task->next)
    if (task->state != kernel::TaskState::blocked || task->finite_wait) return true;
  return false;
}

}  // namespace

void report_deadlock(const kernel::Scheduler& scheduler) {
  const bool stuck = scheduler.stop_cause() != kernel::StopCause::no_progress;
  if (family::family == nullptr || !std::exchange(family::family->is_reported, true)) {
    std::fprintf(stderr, "waitpoint: %s at ", stuck ? "deadlock" : "no progress");
    print_time(scheduler);
    std::fprintf(stderr, "\n");
  }
  for (const kernel::Task* task = scheduler.first_task(); task != nullptr; task = task->next) {
    WAITPOINT_CHECK(is_thread(*task), "a task is reported that is no thread");
    print_wait(*task);
  }
}

bool continues_after_cycle(kernel::Task& task) {
  if (!is_thread(task)) return false;
  if (SignalTimer::any_is_set()) return true;
  const kernel::Scheduler& scheduler = *task.scheduler;
  if (has_host || record->settings.asked != nullptr || !can_others_go_on(scheduler)) return false;
  const ErrorNumberKept kept;
  std::fprintf(stderr, "waitpoint: deadlock at ");
  print_time(scheduler);
  std::fprintf(stderr, ", of some threads; the others continue\n");
  const kernel::Task* const first = scheduler.culprit();
  const kernel::Task* of_cycle = first;
  do {
    WAITPOINT_CHECK(of_cycle != nullptr && of_cycle->blocked_on != nullptr, "a cycle of waiting threads is open");
    print_wait(*of_cycle);
    of_cycle = of_cycle->search.to;
  } while (of_cycle != first);
  return true;
}

}  // namespace waitpoint::posix
