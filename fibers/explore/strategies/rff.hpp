// SPDX-License-Identifier: BSD-3-Clause
// RFF: feedback from the reads-from relation (Wolff, Shi, Duck, Mathur, Roychoudhury, "Greybox fuzzing for concurrency
// testing", ASPLOS 2024). An abstract schedule is a set of constraints: a pair of reads_from.hpp that shall occur, or
// shall not. A schedule follows the priorities of POS, but events that would violate a constraint wait, as long as
// there are others. An abstract schedule whose run has a new pair, or a new combination of pairs, is kept; the next
// ones are mutations of those kept, more of those whose combinations are rare.
//
// So each schedule depends on those before it: see Strategy::first_learned().
#pragma once

#include <unordered_map>

#include "fibers/explore/strategies/pos.hpp"
#include "fibers/explore/strategies/reads_from.hpp"

namespace waitpoint::exploration {

class Rff final : public Drawn {
 public:
  std::uint32_t next(const SwitchPoint& at) override;
  bool end() override;
  std::uint64_t first_learned(std::uint64_t from) const override { return from; }

 private:
  struct Constraint {
    ReadsFrom pair;
    bool is_wanted;
    bool is_met = false;  // wanted, and has occurred in this schedule
  };
  using Constraints = std::vector<Constraint>;
  struct Kept {
    Constraints constraints;
    std::uint64_t combination;  // of the pairs of its run
    std::uint64_t taken;        // the schedules derived from it
  };

  void start(const Profile& profile) override;
  Kept& rare_one();
  void mutate();
  Constraint new_constraint();
  void constrain(const Constraint& constraint);
  bool permits(const Task& task) const;
  void note(const Task& task);
  void keep(std::uint64_t combination);
  std::uint64_t last_change(std::uint64_t object) const;

  static constexpr std::size_t kept_max = 2000, constraints_max = 20;
  static constexpr int compared = 8;
  static constexpr std::uint32_t times_usual = 2;  // the default order's length

  EventPriorities priorities_;
  std::uint32_t held_steps_ = 0;  // the constraints hold up to there: a loop that waits for an event held would not end
  Constraints constraints_;
  std::unordered_map<std::uint64_t, std::uint64_t> changes_;  // by object: the event that has changed it last
  std::vector<ReadsFrom> seen_;                               // the pairs of this schedule

  std::vector<ReadsFrom> known_;  // the pairs of all schedules, in the order of their first occurrence
  std::unordered_map<std::uint64_t, std::uint64_t> times_;  // by pair, and by combination: the schedules that had it
  std::vector<Kept> kept_;
};

}  // namespace waitpoint::exploration
