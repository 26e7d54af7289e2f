// SPDX-License-Identifier: BSD-3-Clause
// What a search has found: the first failure of each kind, and each distinct data race. A line for each is written to
// standard error at once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fibers/explore/search/failures.hpp"
#include "fibers/explore/search/race_findings.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/explore/search/failed_run.hpp"
#include "tools/explore/search/search_progress.hpp"

namespace waitpoint::tools {

class Discoveries {
 public:
  Discoveries(ProcessTarget& target, SearchProgress& progress) : target_(target), progress_(progress) {}

  /// Takes a failed or racing run; runs come in the order of their numbers, so that the lines do not depend on the
  /// number of jobs.
  void take(FailedRun run);

  /// The first run of the gravest kind; null if none failed.
  const FailedRun* gravest() const { return first_.empty() ? nullptr : &first_.rbegin()->second; }
  /// The others, as lines below the report of the gravest, which tells of the races `told`.
  std::string besides(const std::vector<ToldRace>& told) const;

 private:
  ProcessTarget& target_;
  SearchProgress& progress_;
  std::map<ProcessFinding::Kind, FailedRun> first_;
  exploration::RaceFindings races_;
};

}  // namespace waitpoint::tools
