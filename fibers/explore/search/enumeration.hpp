// SPDX-License-Identifier: BSD-3-Clause
// The schedules of an exhaustive strategy, one after the other: of the one that the options name, or of the one that
// follows draws which bring nothing new (Exhaustion). Each is derived from the one before: in this process the strategy
// itself runs it; in another, which only returns what it did, it is a plan.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "fibers/explore/search/omissions.hpp"
#include "fibers/explore/strategies/dfs.hpp"
#include "fibers/explore/strategies/dpor.hpp"
#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"

namespace waitpoint::exploration {

class Enumeration {
 public:
  /// Of the exhaustive strategy that the options name.
  explicit Enumeration(std::string strategy);
  /// Of this one, a literal, after draws.
  static Enumeration after_draws(const char* strategy);

  /// The name of its strategy.
  const std::string& name() const { return name_; }
  /// The same, if it follows draws; else null.
  const char* after_draws() const { return after_draws_; }
  /// The number of the next schedule.
  std::uint64_t number() const { return number_; }
  /// Runs the next schedule, in this process.
  Strategy& strategy() { return *strategy_; }
  /// The next schedule of another process, whose choices are wanted.
  Plan plan() const;

  /// It has ended, with these choices. `apart`: its finding, if another process has run it. False if the strategy is
  /// not possible: of several processes.
  bool take(const RunVerdict& verdict, std::span<const Decision> choices, const Finding* apart);

  /// No schedule is left.
  bool is_over() const { return is_over_; }
  /// After the last one, what was searched: " with at most 2 preemptions, except turns of spinning tasks"; nothing if a
  /// schedule was lost, with those that follow from it, or if schedules prove nothing.
  std::optional<std::string> scope() const;
  /// The reason why all schedules are not all orders; empty if they are.
  std::string unproved() const { return omissions_.unproved(); }
  /// The program's accesses to memory were no switch points.
  bool is_at_calls() const { return omissions_.is_at_calls(); }
  /// All schedules were tried, except spurious wake-ups.
  bool is_complete() const { return is_over_ && !is_broken_ && strategy_->scope().empty() && omissions_.are_usual(); }

 private:
  bool resume(const Lesson& lesson);

  std::string name_;
  const char* after_draws_ = nullptr;
  std::unique_ptr<Strategy> strategy_;
  Dfs* dfs_;  // of the two one is null
  Dpor* dpor_;
  std::uint64_t number_ = 0;
  bool is_over_ = false, is_broken_ = false;
  Omissions omissions_;
};

}  // namespace waitpoint::exploration
