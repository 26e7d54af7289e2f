// SPDX-License-Identifier: BSD-3-Clause
//
// Who waits for whom. A task that is blocked without a timeout on something that is held waits for those who hold it,
// for each of them: so a cycle is a deadlock, whatever else happens.
//
//   A --lock--> left, held by B        B --lock--> map, held by C and D (who read it)        D --lock--> ..., held by A
//
// The search goes from the task that just blocked, depth first, each task once; its state lies in the tasks.
#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {
namespace {

struct Tasks {
  Task* const* first = nullptr;
  std::uint32_t count = 0;
};

// A reader waits for other readers only because a writer stands between them, until it is served or gives up.
bool waits_behind_a_writer(const Object& object) {
  for (const Task* waiter = object.first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
    if (!waiter->shared_wait && !waiter->finite_wait) return true;
  return false;
}

bool waits_for_ever(const Task& task) { return task.state == TaskState::blocked && !task.finite_wait; }

Tasks awaited_by(const Task& task) {
  if (!waits_for_ever(task)) return {};
  const Object& object = *task.blocked_on;
  if (object.owner != nullptr) return {&object.owner, 1};
  if (object.holder_count == 0 || (task.shared_wait && !waits_behind_a_writer(object))) return {};
  return {object.holders, object.holder_count};
}

}  // namespace

bool Scheduler::closes_a_cycle(Task& task) {
  // Mostly who holds it goes on.
  const Task* owner = task.blocked_on->owner;
  if (owner != nullptr && !waits_for_ever(*owner)) return false;
  ++searches_;
  Task* at = &task;
  at->search = {searches_, nullptr, nullptr, 0, true};
  while (at != nullptr) {
    WaitSearch& search = at->search;
    const Tasks awaited = awaited_by(*at);
    if (search.tried == awaited.count) {
      search.on_path = false;
      at = search.from;
      continue;
    }
    Task& next = *awaited.first[search.tried++];
    search.to = &next;
    if (next.search.number != searches_) {
      next.search = {searches_, at, nullptr, 0, true};
      at = &next;
    } else if (next.search.on_path) {
      culprit_ = &next;
      return true;
    }
  }
  return false;
}

bool Scheduler::ends_in_cycle(Task& task) {
  if (!closes_a_cycle(task)) return false;
  if (cycle_handler_ == nullptr || !cycle_handler_(task)) return true;
  culprit_ = nullptr;
  return false;
}

}  // namespace waitpoint::kernel
