// SPDX-License-Identifier: BSD-3-Clause
// What rff has learned from the schedules so far: their reads-from pairs, and the sets of constraints that have led to
// something new, from which the next ones are mutated.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fibers/explore/strategies/draws.hpp"
#include "fibers/explore/strategies/reads_from.hpp"

namespace waitpoint::exploration {

class ReadsFromCorpus {
 public:
  /// The constraints of the next schedule.
  Constraints draw(Draws& draws);
  /// A schedule with these constraints has ended, and had these pairs, in any order: they are sorted.
  void learn(Constraints constraints, std::vector<ReadsFrom>& pairs, Draws& draws);

 private:
  struct Kept {
    Constraints constraints;
    std::uint64_t combination;  // of the pairs of its run
    std::uint64_t taken;        // the schedules derived from it
  };

  Kept& rare_one(Draws& draws);
  void mutate(Constraints& constraints, Draws& draws) const;
  Constraint new_constraint(Draws& draws) const;
  static void constrain(Constraints& constraints, const Constraint& constraint, Draws& draws);

  static constexpr std::size_t kept_max = 2000, constraints_max = 20;
  static constexpr int compared = 8;

  std::vector<ReadsFrom> known_;  // the pairs of all schedules, in the order of their first occurrence
  std::unordered_map<std::uint64_t, std::uint64_t> times_;  // by pair, and by combination: the schedules that had it
  std::vector<Kept> kept_;
};

}  // namespace waitpoint::exploration
