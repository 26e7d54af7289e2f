// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/abstract_state.hpp"

#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration {

AbstractState::LastEvent* AbstractState::Used::of(const Task& task) {
  for (LastEvent& last : last_events)
    if (last.task == task.number) return &last;
  return nullptr;
}

void AbstractState::clear() { ++run_; }

AbstractState::Used& AbstractState::used(std::uint64_t object) {
  Used& found = objects_[object];
  if (found.run == run_) return found;
  found.run = run_;
  found.changes = 0;
  found.last_events.clear();
  return found;
}

const AbstractState::Pending& AbstractState::pending(const Task& task) {
  if (pending_.size() <= task.number) pending_.resize(task.number + 1);
  Pending& known = pending_[task.number];
  if (known.run == run_ && known.sequence == task.sequence) return known;
  const std::uint64_t object = action_of(task).object;
  known = {run_, task.sequence,
           Digest::mix(object ^ Digest::mix(task.id + static_cast<std::uint64_t>(task.operation)))};
  if (object == 0) return known;
  Used& at = used(object);
  known.object = &at;
  if (const LastEvent* const last = at.of(task)) known.changes = last->changes;
  return known;
}

std::uint64_t AbstractState::at(const SwitchPoint& point) {
  std::uint64_t sum = 0;
  for (const Task* task : point.ready) {
    const Pending& event = pending(*task);
    const bool has_changed = event.object != nullptr && event.object->changes != event.changes;
    sum += Digest::mix(event.hash + has_changed);
  }
  return sum;
}

void AbstractState::note(const Task& task) {
  const std::uint64_t at = action_of(task).object;
  if (at == 0) return;
  Used& object = used(at);
  if (!is_read_only(task.operation)) ++object.changes;
  if (LastEvent* const last = object.of(task))
    last->changes = object.changes;
  else
    object.last_events.push_back({task.number, object.changes});
}

}  // namespace waitpoint::exploration
