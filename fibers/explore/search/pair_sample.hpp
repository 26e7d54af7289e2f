// SPDX-License-Identifier: BSD-3-Clause
// How much a search has seen that proves nothing: the reads-from pairs of a sample of its schedules, and the chance
// that the next such schedule shows a pair that none of them has.
//
// The sample is a fixed share of the drawn schedules, of the portfolio the turns of `random`. Each has a random stream
// of its own, and none depends on others: they are independent, and of one distribution. Of T schedules U have a pair
// that no other one has. U / T estimates the chance: leaving out one schedule after the other, it is the mean number
// that shows a pair which the T - 1 others have not (Good 1953; for sampling units that are sets, incidence data, Chao
// and Colwell 2017, and of fuzzers Boehme, STADS, 2018). The estimate's mean square error is, with the chance C,
//
//   (C (1 - C) + 2 V / T) / T
//
// where V is the expected number of pairs of schedules that have a reads-from pair in common with no third one, and
// none of their own. This is Esty's variance (1983), with schedules in place of draws of one species. The interval is
// of all C from which U / T is at most 1.96 standard errors away (Wilson 1927), so that it has a width where U is 0,
// with one more than the observed number for V: a last unseen pair is often the only rare one, and then V is 0. It is
// approximate; the bound by McAllester and Schapire (2000), which holds for each distribution, exceeds 1 with less than
// 300 schedules.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fibers/explore/search/new_pair_chance.hpp"
#include "fibers/explore/strategies/object_table.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/explore/strategies/strategy.hpp"
#include "fibers/explore/strategies/switch_points.hpp"

namespace waitpoint::exploration {

/// In how many schedules of a sample each pair has occurred.
class PairIncidence {
 public:
  /// A schedule has ended that had these pairs, in any order and any number of times.
  void take(std::span<const ReadsFrom> pairs);
  /// Nothing of less than two schedules.
  std::optional<NewPairChance> chance() const;
  std::uint64_t schedules() const { return unique_.size(); }

 private:
  using Schedule = std::uint32_t;
  struct Witnesses {
    std::uint32_t count = 0;  // at most 3
    Schedule first = 0, second = 0, last = 0;
  };

  void note(Witnesses& witnesses, Schedule schedule);

  ObjectTable<Witnesses> witnesses_;  // by the pair's hash
  std::uint64_t pairs_ = 0;
  std::vector<std::uint32_t> unique_;                              // by schedule: the pairs that no other has
  std::uint64_t with_unique_ = 0;                                  // schedules that have some
  std::map<std::pair<Schedule, Schedule>, std::uint32_t> shared_;  // pairs that these two have, and no other
};

/// The drawn schedules of a search that are of its sample.
class SampledSchedules {
 public:
  /// Each of `share` schedules in turn; as many as the portfolio has turns, of which the first is `random`.
  static constexpr std::uint64_t share = 12;

  explicit SampledSchedules(const std::string& strategy);
  bool contain(std::uint64_t number) const {
    return number % share == 0 && is_random_ && strategy_->first_learned(number) != number;
  }

 private:
  std::shared_ptr<const Strategy> strategy_;
  bool is_random_;
};

/// The sample of a search. Schedules with other switch points have other events: they are samples by themselves.
class PairSample {
 public:
  /// `strategy`: of the search.
  explicit PairSample(const std::string& strategy)
      : schedules_(strategy), drawn_by_(strategy == "portfolio" ? "random" : strategy) {}

  bool contains(std::uint64_t number) const { return schedules_.contain(number); }
  void take(std::span<const ReadsFrom> pairs, SwitchAt at) {
    (at == SwitchAt::accesses ? at_accesses_ : at_calls_).take(pairs);
  }
  /// Of the schedules with accesses as switch points, if there are any.
  std::optional<NewPairChance> chance() const;

 private:
  SampledSchedules schedules_;
  std::string drawn_by_;
  PairIncidence at_calls_, at_accesses_;
};

}  // namespace waitpoint::exploration
