// SPDX-License-Identifier: BSD-3-Clause
// What --json prints of a search, and of a replayed schedule.
#pragma once

#include <string>

#include "fibers/explore/search/search.hpp"
#include "tools/explore/report/failure_report.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

/// A failure, and how it is repeated.
struct ReportedFailure {
  const Finding& finding;
  const FailureReport& report;
};

/// `search` took `seconds`; null: the default order has failed, and nothing else was run. `failure` is null if no
/// schedule failed.
std::string search_json(const std::string& target, const exploration::Search* search, double seconds,
                        const ReportedFailure* failure);

}  // namespace waitpoint::tools
