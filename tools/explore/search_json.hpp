// SPDX-License-Identifier: BSD-3-Clause
// What --json prints of a search, and of a replayed schedule.
#pragma once

#include <optional>
#include <string>

#include "tools/explore/report/failure_report.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

/// The counts of a search; see class Search.
struct SearchCounts {
  std::uint64_t schedules = 0, distinct = 0, failures = 0, raced = 0;
  double seconds = 0;
  bool is_interrupted = false;
  std::optional<std::string> scope = {};  ///< of an exhausted search
  std::string obstacle = {};              ///< to accesses as switch points
};

/// A failure, and how it is repeated.
struct ReportedFailure {
  const ProcessFinding& finding;
  const FailureReport& report;
};

/// Without counts the default order has failed, and nothing else was run. `failure` is null if no schedule failed.
std::string search_json(const std::string& target, const std::optional<SearchCounts>& counts,
                        const ReportedFailure* failure);

}  // namespace waitpoint::tools
