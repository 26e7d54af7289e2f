// SPDX-License-Identifier: BSD-3-Clause
// The report of a target's failure for people: the failure, minimised to the fewest switches found, the last choice
// that mattered, the last events of the tasks, and the replay command.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/report/finding_file.hpp"
#include "fibers/explore/search/failed_run.hpp"
#include "tools/explore/replay/schedule_file.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/explore/search/search_progress.hpp"

namespace waitpoint::tools {

struct FailureReport {
  std::string text;                                 ///< several lines
  StoredSchedule schedule;                          ///< the minimised one
  std::string trace;                                ///< of its last seconds, if requested
  std::vector<ToldRace> races = {};                 ///< that the text tells of
  std::optional<exploration::Finding> graver = {};  ///< as in Analysis
  /// With the schedules, if ExploreOptions::tells_finding().
  exploration::FindingFile finding = {};
};

/// The report of a failing default order.
FailureReport report_default(ProcessTarget& target, SearchProgress& progress, const Finding& finding);
/// The report of a failure found by a search. Takes at most a few minutes.
FailureReport report(ProcessTarget& target, SearchProgress& progress, const exploration::FailedRun& failed);

}  // namespace waitpoint::tools
