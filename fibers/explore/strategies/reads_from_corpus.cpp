// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/reads_from_corpus.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::exploration {

Constraints ReadsFromCorpus::draw(Draws& draws) {
  Constraints constraints;
  if (known_.empty()) return constraints;
  if (!kept_.empty()) constraints = rare_one(draws).constraints;
  mutate(constraints, draws);
  return constraints;
}

// Of some kept ones, the one whose combination the fewest schedules had and that was taken the fewest times.
ReadsFromCorpus::Kept& ReadsFromCorpus::rare_one(Draws& draws) {
  Kept* rarest = nullptr;
  for (int i = 0; i < compared; ++i) {
    Kept& one = kept_[draws.below(kept_.size())];
    if (rarest == nullptr || one.taken + times_[one.combination] < rarest->taken + times_[rarest->combination])
      rarest = &one;
  }
  ++rarest->taken;
  return *rarest;
}

// A pair, or the writer of one with the reader of another at the same object.
Constraint ReadsFromCorpus::new_constraint(Draws& draws) const {
  ReadsFrom pair = known_[draws.below(known_.size())];
  const ReadsFrom& other = known_[draws.below(known_.size())];
  if (other.object == pair.object) pair.writer = other.writer;
  return {pair, draws.below(2) == 0};
}

// An abstract event reads from one other: a constraint takes the place of an earlier one of the same reader.
void ReadsFromCorpus::constrain(Constraints& constraints, const Constraint& constraint, Draws& draws) {
  for (Constraint& other : constraints)
    if (other.pair.reader == constraint.pair.reader) {
      other = constraint;
      return;
    }
  if (constraints.size() < constraints_max)
    constraints.push_back(constraint);
  else
    constraints[draws.below(constraints_max)] = constraint;
}

// Adds a constraint, removes one, or reverses one, several times now and then.
void ReadsFromCorpus::mutate(Constraints& constraints, Draws& draws) const {
  do {
    const std::uint64_t which = constraints.empty() ? 0 : draws.below(4);
    const auto at = static_cast<std::ptrdiff_t>(constraints.empty() ? 0 : draws.below(constraints.size()));
    if (which == 2)
      constraints.erase(constraints.begin() + at);
    else if (which == 3)
      constraints[static_cast<std::size_t>(at)].is_wanted ^= true;
    else
      constrain(constraints, new_constraint(draws), draws);
  } while (draws.below(4) == 0);
}

// A new pair becomes a constraint of the schedule that has it.
void ReadsFromCorpus::learn(Constraints constraints, std::vector<ReadsFrom>& pairs, Draws& draws) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::uint64_t combination = 0;
  bool is_new = false;
  for (const ReadsFrom& pair : pairs) {
    const std::uint64_t hash = pair.hash();
    combination = Digest::mix(combination ^ hash);
    if (times_[hash]++ > 0) continue;
    known_.push_back(pair);
    is_new = true;
    constrain(constraints, {pair, true}, draws);
  }
  if (times_[combination]++ > 0 && !is_new) return;
  for (Constraint& constraint : constraints) constraint.is_met = false;
  Kept kept{std::move(constraints), combination, 0};
  if (kept_.size() < kept_max)
    kept_.push_back(std::move(kept));
  else
    kept_[draws.below(kept_max)] = std::move(kept);
}

}  // namespace waitpoint::exploration
