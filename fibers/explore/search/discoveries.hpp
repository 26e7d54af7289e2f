// SPDX-License-Identifier: BSD-3-Clause
// What a search has found: the first failure of each kind, and each distinct data race. A line for each is written to
// standard error at once, as the process may end before the report; of failures if there is progress to be seen.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fibers/explore/search/failed_run.hpp"
#include "fibers/explore/search/race_findings.hpp"
#include "fibers/explore/target/progress_listener.hpp"
#include "fibers/explore/target/target.hpp"

namespace waitpoint::exploration {

class Discoveries {
 public:
  /// `progress` may be null. `call` as in token_of().
  Discoveries(Target& target, const ExploreOptions& options, ProgressListener* progress, std::uint32_t call = 0)
      : target_(target), options_(options), progress_(progress), call_(call) {}

  /// Takes a failed or racing run; runs come in the order of their numbers, so that the lines do not depend on the
  /// number of jobs.
  void take(FailedRun run);

  /// The first run of the gravest kind; null if none failed.
  const FailedRun* gravest() const { return first_.empty() ? nullptr : &first_.rbegin()->second; }
  /// The others, as lines below the report of `reported`, which tells of the races `told`.
  std::string besides(const FailedRun& reported, const std::vector<ToldRace>& told) const;
  /// Each race as text.
  std::vector<std::string> races() const { return races_.texts(); }

 private:
  std::string replay_of(const FailedRun& run) const;

  Target& target_;
  const ExploreOptions& options_;
  ProgressListener* progress_;
  std::uint32_t call_;
  std::map<RunVerdict::Kind, FailedRun> first_;
  RaceFindings races_;
};

}  // namespace waitpoint::exploration
