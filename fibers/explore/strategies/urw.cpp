// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/urw.hpp"

#include <algorithm>

namespace waitpoint::exploration {

void Urw::start(const Profile& profile) {
  profile_ = &profile;
  remaining_.clear();
  ids_.clear();
  intended_ = nullptr;
  object_ = selective_ && !profile.shared.empty() ? profile.shared[draw(profile.shared.size())] : 0;
}

// The relevant events of `task` and of all its descendants.
std::uint64_t Urw::expected(const Profile::TaskEvents& task) const {
  std::uint64_t count = object_ == 0
                            ? task.events
                            : static_cast<std::uint64_t>(std::count(task.objects.begin(), task.objects.end(), object_));
  for (const Profile::TaskEvents& child : profile_->tasks)
    if (child.parent == task.task) count += expected(child);
  return count;
}

// The first sight of a task: its events are subtracted from its maker's.
void Urw::meet(const Task& task) {
  if (ids_.size() <= task.number) {
    remaining_.resize(task.number + 1, 0);
    ids_.resize(task.number + 1, 0);
  }
  ids_[task.number] = task.id;
  const Profile::TaskEvents* known = profile_->find(task.id);
  if (known == nullptr) return;
  const std::uint64_t own = expected(*known);
  remaining_[task.number] = own;
  for (std::size_t i = 0; i < ids_.size(); ++i)
    if (ids_[i] == known->parent) remaining_[i] -= std::min(remaining_[i], own);
}

bool Urw::counts(const Task& task) const {
  return object_ == 0 || (task.at != nullptr && task.at->identity == object_);
}

std::uint32_t Urw::weighted(const SwitchPoint& at) {
  const std::uint64_t* const remaining = remaining_.data();
  std::uint64_t sum = 0;
  for (const Task* task : at.ready) sum += remaining[task->number] + 1;
  std::uint64_t drawn = draws_.below(sum);
  std::uint32_t chosen = 0;
  for (; drawn > remaining[at.ready[chosen]->number]; ++chosen) drawn -= remaining[at.ready[chosen]->number] + 1;
  return chosen;
}

// Any task, except those that would reach the object out of turn.
std::uint32_t Urw::selected(const SwitchPoint& at) {
  const bool waits = std::find(at.ready.begin(), at.ready.end(), intended_) == at.ready.end();
  if (intended_ == nullptr || waits) intended_ = at.ready[weighted(at)];
  if (free_.size() < at.ready.size()) free_.resize(at.ready.size());
  std::uint32_t free = 0;
  for (std::uint32_t i = 0; i < at.ready.size(); ++i) {
    free_[free] = i;
    free += at.ready[i] == intended_ || !counts(*at.ready[i]);
  }
  return free_[draw(free)];
}

std::uint32_t Urw::next(const SwitchPoint& at) {
  for (const Task* task : at.ready)
    if (!has_met(*task)) meet(*task);
  const std::uint32_t chosen = at.ready.size() == 1 ? 0 : object_ == 0 ? weighted(at) : selected(at);
  const Task& task = *at.ready[chosen];
  if (counts(task)) {
    if (remaining_[task.number] > 0) --remaining_[task.number];
    intended_ = nullptr;
  }
  return chosen;
}

}  // namespace waitpoint::exploration
