// SPDX-License-Identifier: BSD-3-Clause
// The report of a target's failure for people: the failure, minimised to the fewest switches found, the last choice
// that mattered, the last events of the tasks, and the replay command.
#pragma once

#include <string>

#include "tools/explore/schedule_file.hpp"
#include "tools/explore/search.hpp"

namespace waitpoint::tools {

struct FailureReport {
  std::string text;         ///< several lines
  StoredSchedule schedule;  ///< the minimised one
  std::string trace;        ///< of its last seconds, if requested
};

/// The report of a failing default order.
FailureReport report_default(Target& target, const Finding& finding);
/// The report of a failure found by a search. Takes at most a few minutes.
FailureReport report(Target& target, SearchProgress& progress, const Search::Failed& failed);

/// The command that repeats the target's run with these options; with `replayed`, a token or a file's name, that
/// schedule.
std::string replay_command(const ExploreOptions& options, const std::string& replayed = "");

}  // namespace waitpoint::tools
