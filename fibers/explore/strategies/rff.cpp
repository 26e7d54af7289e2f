// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/rff.hpp"

#include <utility>

namespace waitpoint::exploration {

void Rff::start(const Profile& profile) {
  held_steps_ = times_usual * profile.steps;
  priorities_.clear(profile.memory);
  relation_.clear();
  constraints_ = given_.empty() ? corpus_.draw(draws_) : given_;
}

// False if the pending event would read from another event than wanted, read from one that is not, or change what is
// still to be read.
bool Rff::permits(const Task& task) {
  bool is_permitted = true;
  for_each_abstract_event(task, [&](const AbstractEvent& one) {
    for (const Constraint& constraint : constraints_) {
      if (constraint.pair.object != one.object || constraint.is_met) continue;
      const bool reads = one.event == constraint.pair.reader;
      const bool is_there = relation_.last_change(one.object) == constraint.pair.writer;
      if (reads ? is_there != constraint.is_wanted : is_there && constraint.is_wanted && one.changes)
        is_permitted = false;
    }
  });
  return is_permitted;
}

void Rff::note(const Task& task) {
  relation_.note(task, [this](const ReadsFrom& pair) {
    for (Constraint& constraint : constraints_)
      if (constraint.is_wanted && constraint.pair == pair) constraint.is_met = true;
  });
}

std::uint32_t Rff::next(const SwitchPoint& at) {
  const bool holds = at.step < held_steps_;
  const auto is_permitted = [&](const Task& task) { return !holds || permits(task); };
  const std::uint32_t chosen = at.ready.size() == 1 ? 0 : priorities_.next(at, draws_, is_permitted);
  note(*at.ready[chosen]);
  return chosen;
}

bool Rff::end() {
  corpus_.learn(std::move(constraints_), relation_.pairs(), draws_);
  return true;
}

}  // namespace waitpoint::exploration
