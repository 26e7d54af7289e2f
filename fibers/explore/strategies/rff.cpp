// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/rff.hpp"

#include <utility>

namespace waitpoint::exploration {

void Rff::start(const Profile& profile) {
  held_steps_ = times_usual * profile.steps;
  priorities_.clear(profile.memory);
  changes_.clear();
  seen_.clear();
  constraints_ = given_.empty() ? corpus_.draw(draws_) : given_;
}

std::uint64_t Rff::last_change(std::uint64_t object) const {
  const auto known = changes_.find(object);
  return known != changes_.end() ? known->second : ReadsFrom::start;
}

// False if the pending event would read from another event than wanted, read from one that is not, or change what is
// still to be read.
bool Rff::permits(const Task& task) const {
  if (task.at == nullptr) return true;
  const std::uint64_t object = task.at->identity;
  for (const Constraint& constraint : constraints_) {
    if (constraint.pair.object != object || constraint.is_met) continue;
    const bool reads = abstract_event(task) == constraint.pair.reader;
    const bool is_there = last_change(object) == constraint.pair.writer;
    if (reads && is_there != constraint.is_wanted) return false;
    if (!reads && is_there && constraint.is_wanted && !is_read_only(task.operation)) return false;
  }
  return true;
}

void Rff::note(const Task& task) {
  const std::uint64_t event = abstract_event(task);
  if (event == 0) return;
  const ReadsFrom pair{task.at->identity, last_change(task.at->identity), event};
  seen_.push_back(pair);
  for (Constraint& constraint : constraints_)
    if (constraint.is_wanted && constraint.pair == pair) constraint.is_met = true;
  if (!is_read_only(task.operation)) changes_[pair.object] = event;
}

std::uint32_t Rff::next(const SwitchPoint& at) {
  const bool holds = at.step < held_steps_;
  const auto is_permitted = [&](const Task& task) { return !holds || permits(task); };
  const std::uint32_t chosen = at.ready.size() == 1 ? 0 : priorities_.next(at, draws_, is_permitted);
  note(*at.ready[chosen]);
  return chosen;
}

bool Rff::end() {
  corpus_.learn(std::move(constraints_), seen_, draws_);
  return true;
}

}  // namespace waitpoint::exploration
