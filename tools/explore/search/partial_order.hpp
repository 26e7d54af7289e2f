// SPDX-License-Identifier: BSD-3-Clause
// Enumerates schedules without equivalent ones, by the strategy dpor: its search tree is passed from run to run.
#pragma once

#include "fibers/explore/strategies/dpor.hpp"
#include "tools/explore/search/exhaustive.hpp"

namespace waitpoint::tools {

class PartialOrder final : public Exhaustive {
 public:
  PartialOrder() : Exhaustive(exploration::up_to_equivalence) {}

  Plan first() const override { return {.strategy = "dpor"}; }

 private:
  std::optional<Plan> next(const ProcessFinding& finding) override;
};

}  // namespace waitpoint::tools
