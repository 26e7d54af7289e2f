// SPDX-License-Identifier: BSD-3-Clause
// The schedules of an exhaustive strategy, one after the other: the one that the options name, or those that follow
// when draws bring nothing new (exploration::Exhaustion).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tools/explore/search/exhaustive.hpp"

namespace waitpoint::tools {

class Enumeration {
 public:
  /// Of this strategy, the options'; null if that draws.
  static std::optional<Enumeration> of_options(const std::string& strategy);
  /// Of this exhaustive strategy, after draws.
  static Enumeration after_draws(const std::string& strategy);

  /// The name of the strategy; empty: that of the options.
  const std::string& name() const { return name_; }
  std::uint64_t number() const { return number_; }
  /// The next schedule, of that number; nothing after the last.
  const std::optional<Plan>& next() const { return next_; }
  /// Its run has ended: its choices were wanted. False if the strategy is not possible: of several processes.
  bool take(const ProcessFinding& finding);
  /// After the last: Exhaustive::scope().
  std::optional<std::string> scope() const { return schedules_->scope(); }
  std::string unproved() const { return schedules_->unproved(); }

 private:
  Enumeration(std::string name, std::unique_ptr<Exhaustive> schedules)
      : name_(std::move(name)), schedules_(std::move(schedules)), next_(schedules_->first()) {}

  std::string name_;
  std::unique_ptr<Exhaustive> schedules_;
  std::optional<Plan> next_;
  std::uint64_t number_ = 0;
};

}  // namespace waitpoint::tools
