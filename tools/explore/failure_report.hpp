// SPDX-License-Identifier: BSD-3-Clause
// A failure of a scene for a person: what failed, in as few switches as can be found, the last choice that mattered,
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
FailureReport report_default(Scene& scene, const Finding& finding);
/// Of what failed in a search. Takes some minutes at most.
FailureReport report(Scene& scene, SearchProgress& progress, const Search::Failed& failed);

/// The command that runs the scenario with these options, up to what is written behind --replay.
std::string replay_command(const ExploreOptions& options);

}  // namespace waitpoint::tools
