// SPDX-License-Identifier: BSD-3-Clause
// All schedules of a target, one after the other: after each the last choice that has an alternative left takes it, and
// behind that all goes as usual. Nothing is kept from one to the next but what the last one chose, so that each can be
// a process of its own. The strategies dfs and bounded:K, in the order of these: see fibers/explore/strategies/dfs.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::tools {

class DepthFirst {
 public:
  /// By the name of a strategy; nothing for one that does not go so.
  static std::optional<DepthFirst> of(const std::string& strategy);

  /// The schedule behind one that chose so, as its deviations from the default order; nothing if it was the last.
  std::optional<std::vector<exploration::Deviation>> after(const std::vector<exploration::Decision>& decisions);

  /// Once all were tried, what they are all of: " with at most 2 preemptions, but for turns of tasks that spin".
  std::string scope() const;

 private:
  DepthFirst(std::uint32_t preemptions, std::string scope) : preemptions_(preemptions), scope_(std::move(scope)) {}

  std::uint32_t preemptions_;
  std::string scope_;
  bool left_out_turns_ = false, left_out_costs_ = false, left_out_spurious_ = false;
};

}  // namespace waitpoint::tools
