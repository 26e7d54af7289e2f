// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/partial_order.hpp"

#include "core/error.hpp"

namespace waitpoint::tools {

std::optional<Plan> PartialOrder::next(const ProcessFinding& finding) {
  if (finding.lesson.progress.empty())
    throw BadInput("--strategy",
                   "expected dfs or bounded:K, as the program starts processes or other programs, found 'dpor'");
  exploration::Dpor search;
  search.resume(finding.lesson.progress);
  if (!search.end()) return std::nullopt;
  Plan plan = first();
  plan.progress = search.progress();
  return plan;
}

}  // namespace waitpoint::tools
