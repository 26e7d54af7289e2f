// SPDX-License-Identifier: BSD-3-Clause
// RFF: feedback from the reads-from relation (Wolff, Shi, Duck, Mathur, Roychoudhury, "Greybox fuzzing for concurrency
// testing", ASPLOS 2024). An abstract schedule is a set of constraints: a pair of reads_from.hpp that shall occur, or
// shall not. A schedule follows the priorities of POS, but events that would violate a constraint wait, as long as
// there are others. An abstract schedule whose run has a new pair, or a new combination of pairs, is kept; the next
// ones are mutations of those kept, more of those whose combinations are rare.
//
// So each schedule depends on those before it: see Strategy::first_learned().
#pragma once

#include "fibers/explore/strategies/pos.hpp"
#include "fibers/explore/strategies/reads_from_corpus.hpp"

namespace waitpoint::exploration {

class Rff final : public Drawn {
 public:
  std::uint32_t next(const SwitchPoint& at) override;
  bool end() override;
  std::uint64_t first_learned(std::uint64_t from) const override { return from; }
  std::uint64_t first_held(std::uint64_t from) const override { return from; }
  void hold(std::span<const Constraint> constraints) override { given_.assign(constraints.begin(), constraints.end()); }

 private:
  void start(const Profile& profile) override;
  bool permits(const Task& task);
  void note(const Task& task);

  static constexpr std::uint32_t times_usual = 2;  // the default order's length

  ReadsFromCorpus corpus_;  // of this process's schedules
  Constraints given_;       // of another process's corpus, for the next schedule
  EventPriorities priorities_;
  std::uint32_t held_steps_ = 0;  // the constraints hold up to there: a loop that waits for an event held would not end
  Constraints constraints_;
  ReadsFromRelation relation_;  // of this schedule
};

}  // namespace waitpoint::exploration
