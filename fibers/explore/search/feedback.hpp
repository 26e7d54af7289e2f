// SPDX-License-Identifier: BSD-3-Clause
// Feedback between the schedules of a program, for strategies that learn: the schedules are other processes', so what
// has been learned is kept here, and each schedule that learns is told its constraints.
//
// A schedule learns from those of the generations before its own, of eight learning schedules each: so several can run
// at once, and the result does not depend on how many do, or where. docs/decisions/feedback-in-generations.md.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "fibers/explore/strategies/reads_from_corpus.hpp"
#include "fibers/explore/strategies/strategy.hpp"
#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"

namespace waitpoint::exploration {

class Feedback {
 public:
  Feedback(const std::string& strategy, std::uint64_t seed);

  /// The first schedule that learns whose plan was not asked for; Strategy::none if there is none.
  std::uint64_t next() const { return next_; }
  bool is_learned(std::uint64_t number) const { return strategy_->first_held(number) == number; }
  /// The plan of schedule next(), which becomes the one after; nothing until all of the generations before were told.
  std::optional<Plan> plan_of_next();
  /// Such a schedule has ended; its pairs were requested.
  void take(std::uint64_t number, const Finding& finding);

  /// The plan of a drawn schedule by itself: `run` executes those that it learns from.
  Plan plan_of(std::uint64_t number, const std::function<Finding(const Plan& plan)>& run);

 private:
  static constexpr std::size_t generation = 8;

  struct Lesson {
    Constraints constraints;
    std::optional<std::vector<ReadsFrom>> pairs;  // once it has ended
  };
  bool learn();

  std::unique_ptr<Strategy> strategy_;
  std::uint64_t seed_;
  std::uint64_t next_;
  std::map<std::uint64_t, Lesson> lessons_;  // by number: the present generation's
  ReadsFromCorpus corpus_;
};

}  // namespace waitpoint::exploration
