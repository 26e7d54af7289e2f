// SPDX-License-Identifier: BSD-3-Clause
// Enumerates schedules depth first: the next schedule takes the next alternative at the last choice that has one left,
// and follows the default order after it. Only the last schedule's choices are kept between runs, so that each run can
// be a process of its own, and may be a family of processes. Implements the strategies dfs and bounded:K in the same
// order as fibers/explore/strategies/dfs.hpp.
#pragma once

#include <cstdint>
#include <string>

#include "tools/explore/search/exhaustive.hpp"

namespace waitpoint::tools {

class DepthFirst final : public Exhaustive {
 public:
  DepthFirst(std::uint32_t preemptions, std::string scope) : Exhaustive(std::move(scope)), preemptions_(preemptions) {}

  Plan first() const override { return {.drawn = false}; }

 private:
  std::optional<Plan> next(const ProcessFinding& finding) override;

  std::uint32_t preemptions_;
};

}  // namespace waitpoint::tools
