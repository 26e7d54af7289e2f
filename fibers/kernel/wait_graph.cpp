// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/wait_graph.hpp"

namespace waitpoint::kernel {
namespace {

struct Tasks {
  Task* const* first = nullptr;
  std::uint32_t count = 0;
};

// A reader waits for the readers that hold the lock only while a writer is queued.
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

Task* WaitGraph::find_cycle(Task& task) {
  // The common case: the owner is not blocked.
  const Task* owner = task.blocked_on->owner;
  if (owner != nullptr && !waits_for_ever(*owner)) return nullptr;
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
      return &next;
    }
  }
  return nullptr;
}

}  // namespace waitpoint::kernel
