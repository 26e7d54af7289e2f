// SPDX-License-Identifier: BSD-3-Clause
// A failure of a target for a person: what failed, in as few switches as can be found, the last choice that mattered,
// what the tasks did last, and the line that repeats it.
#pragma once

#include <string>

#include "tools/explore/schedule_file.hpp"
#include "tools/explore/search.hpp"

namespace waitpoint::tools {

struct FailureReport {
  std::string text;         ///< some lines
  StoredSchedule schedule;  ///< the least that was found
  std::string trace;        ///< of its last seconds, where the options ask for it
};

/// Of what the default order comes to.
FailureReport report_default(Target& target, const Finding& finding);
/// Of what failed in a search. Takes some minutes at most.
FailureReport report(Target& target, SearchProgress& progress, const Search::Failed& failed);

/// The command that runs the target with these options; with `replayed`, a token or a file's name, that schedule of it.
std::string replay_command(const ExploreOptions& options, const std::string& replayed = "");

}  // namespace waitpoint::tools
