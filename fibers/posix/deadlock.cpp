// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/deadlock.hpp"

#include <cstdio>
#include <cstring>

#include "fibers/posix/symbols.hpp"
#include "fibers/posix/thread.hpp"
#include "fibers/posix/waitable.hpp"

namespace waitpoint::posix {
namespace {

// "main", or "reader: main" where there are several programs.
void print_name(const kernel::Task& task) {
  if (thread_of(task).program->is_member) std::fprintf(stderr, "%s: ", task.robot->name);
  std::fprintf(stderr, "%s", task.name);
}

// "mutex jobs_lock", or with its address where no symbol of the program names it.
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

}  // namespace

void report_deadlock(const kernel::Scheduler& scheduler) {
  constexpr long long second_ns = 1'000'000'000;
  const long long now_ns = scheduler.global_time().ns();
  const bool stuck = scheduler.stop_cause() != kernel::StopCause::no_progress;
  std::fprintf(stderr, "waitpoint: %s at %lld.%09lld s of virtual time\n", stuck ? "deadlock" : "no progress",
               now_ns / second_ns, now_ns % second_ns);
  for (const kernel::Task* task = scheduler.first_task(); task != nullptr; task = task->next) {
    std::fprintf(stderr, "  ");
    print_name(*task);
    if (task->blocked_on == nullptr) {
      std::fprintf(stderr, " can go on");
    } else {
      std::fprintf(stderr, " waits for ");
      print_object(*task->blocked_on);
      if (const kernel::Task* owner = task->blocked_on->owner; owner != nullptr) {
        const bool is_end = std::strcmp(task->blocked_on->kind, "thread") == 0;
        std::fprintf(stderr, ", %s ", is_end ? "that is" : "held by");
        owner == task ? static_cast<void>(std::fprintf(stderr, "itself")) : print_name(*owner);
      }
    }
    std::fprintf(stderr, "\n");
  }
}

}  // namespace waitpoint::posix
