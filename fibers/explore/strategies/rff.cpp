// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/rff.hpp"

#include <algorithm>

namespace waitpoint::exploration {

void Rff::start(const Profile& profile) {
  held_steps_ = times_usual * profile.steps;
  priorities_.clear();
  changes_.clear();
  seen_.clear();
  constraints_.clear();
  if (known_.empty()) return;
  if (!kept_.empty()) constraints_ = rare_one().constraints;
  mutate();
}

// Of some kept ones, the one whose combination the fewest schedules had and that was taken the fewest times.
Rff::Kept& Rff::rare_one() {
  Kept* rarest = nullptr;
  for (int i = 0; i < compared; ++i) {
    Kept& one = kept_[draw(kept_.size())];
    if (rarest == nullptr || one.taken + times_[one.combination] < rarest->taken + times_[rarest->combination])
      rarest = &one;
  }
  ++rarest->taken;
  return *rarest;
}

// A pair, or the writer of one with the reader of another at the same object.
Rff::Constraint Rff::new_constraint() {
  ReadsFrom pair = known_[draw(known_.size())];
  const ReadsFrom& other = known_[draw(known_.size())];
  if (other.object == pair.object) pair.writer = other.writer;
  return {pair, draw(2) == 0};
}

// An abstract event reads from one other: a constraint takes the place of an earlier one of the same reader.
void Rff::constrain(const Constraint& constraint) {
  for (Constraint& other : constraints_)
    if (other.pair.reader == constraint.pair.reader) {
      other = constraint;
      return;
    }
  if (constraints_.size() < constraints_max)
    constraints_.push_back(constraint);
  else
    constraints_[draw(constraints_max)] = constraint;
}

// Adds a constraint, removes one, or reverses one, several times now and then.
void Rff::mutate() {
  do {
    const std::uint32_t which = constraints_.empty() ? 0 : draw(4);
    const auto at = static_cast<std::ptrdiff_t>(constraints_.empty() ? 0 : draw(constraints_.size()));
    if (which == 2)
      constraints_.erase(constraints_.begin() + at);
    else if (which == 3)
      constraints_[static_cast<std::size_t>(at)].is_wanted ^= true;
    else
      constrain(new_constraint());
  } while (draw(4) == 0);
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

void Rff::keep(std::uint64_t combination) {
  for (Constraint& constraint : constraints_) constraint.is_met = false;
  if (kept_.size() < kept_max)
    kept_.push_back({constraints_, combination, 0});
  else
    kept_[draw(kept_max)] = {constraints_, combination, 0};
}

// A new pair becomes a constraint of the schedule that has it.
bool Rff::end() {
  std::sort(seen_.begin(), seen_.end());
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
  std::uint64_t combination = 0;
  bool is_new = false;
  for (const ReadsFrom& pair : seen_) {
    const std::uint64_t hash = pair.hash();
    combination = Digest::mix(combination ^ hash);
    if (times_[hash]++ > 0) continue;
    known_.push_back(pair);
    is_new = true;
    constrain({pair, true});
  }
  if (times_[combination]++ == 0 || is_new) keep(combination);
  return true;
}

}  // namespace waitpoint::exploration
