// SPDX-License-Identifier: BSD-3-Clause
// Enumerates schedules without equivalent ones, by the strategy dpor: its search tree is passed from run to run.
#pragma once

#include "tools/explore/exhaustive.hpp"

namespace waitpoint::tools {

class PartialOrder final : public Exhaustive {
 public:
  PartialOrder() : Exhaustive(" up to the order of independent events, if there are no data races") {}

  Plan first() const override { return {}; }

 private:
  std::optional<Plan> next(const Finding& finding) override;
};

}  // namespace waitpoint::tools
