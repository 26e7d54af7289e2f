// SPDX-License-Identifier: BSD-3-Clause
// Enumerates all schedules of a target depth first: the next schedule takes the next alternative at the last choice
// that has one left, and follows the default order after it. Only the last schedule's choices are kept between runs, so
// that each run can be a process of its own. Implements the strategies dfs and bounded:K in the same order as
// fibers/explore/strategies/dfs.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/strategies/schedule.hpp"
#include "tools/explore/finding.hpp"

namespace waitpoint::tools {

class DepthFirst {
 public:
  /// For the name of a strategy; nothing if that is not exhaustive.
  static std::optional<DepthFirst> of(const std::string& strategy);

  /// The successor of the schedule of `finding`, whose choices were requested, as deviations from the default order;
  /// nothing after the last.
  std::optional<std::vector<exploration::Deviation>> after(const Finding& finding);

  /// The scope of an exhausted search: " with at most 2 preemptions, except for turns of spinning tasks".
  std::string scope() const;

 private:
  DepthFirst(std::uint32_t preemptions, std::string scope) : preemptions_(preemptions), scope_(std::move(scope)) {}

  std::uint32_t preemptions_;
  std::string scope_;
  bool left_out_turns_ = false, left_out_costs_ = false, left_out_spurious_ = false, left_out_accesses_ = false;
};

}  // namespace waitpoint::tools
