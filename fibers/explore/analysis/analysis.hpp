// SPDX-License-Identifier: BSD-3-Clause
// The analysis of a failure: minimised to the fewest switches found, the last choice that mattered, the two events
// whose order matters, the last events of the tasks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/report/finding_file.hpp"
#include "fibers/explore/target/progress_listener.hpp"
#include "fibers/explore/target/target.hpp"

namespace waitpoint::exploration {

struct AnalysisOptions {
  bool minimize = true;
  bool page = false;   ///< the schedules for a page are wanted
  bool trace = false;  ///< a trace of the last seconds is wanted
};

struct Analysis {
  Plan plan;                         ///< of the least failing run
  Finding least;                     ///< its result
  bool is_minimized = false;         ///< `plan` gives its deviations; otherwise it is the one that was found
  std::string words;                 ///< the failure, with the source locations of the tasks; empty if not repeated
  std::string text;                  ///< lines for people
  std::vector<ToldRace> races = {};  ///< that the least run shows
  std::string trace = {};
  std::optional<Finding> graver = {};  ///< a failure of a graver kind in one of the runs
  FindingFile finding = {};            ///< its choice, note and steps; with AnalysisOptions::page its schedules
};

/// Of the failure `found` by a run of `plan`, of which the default order has neither switches nor deviations.
/// `progress` may be null.
Analysis analyse(Target& target, ProgressListener* progress, const Plan& plan, const Finding& found,
                 const AnalysisOptions& options);

}  // namespace waitpoint::exploration
