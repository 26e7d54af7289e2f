// SPDX-License-Identifier: BSD-3-Clause
// One call of explore(): runs schedules of one body until one fails or a limit is reached.
#pragma once

#include <functional>
#include <string>

#include "fibers/explore/body.hpp"
#include "fibers/explore/body_runs.hpp"
#include "fibers/explore/body_target.hpp"
#include "fibers/explore/explore_report.hpp"
#include "fibers/explore/report/finding_file.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/search/search.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/explore/supervisor.hpp"
#include "fibers/explore/target/explore_options.hpp"

namespace waitpoint::exploration {

class Campaign {
 public:
  /// `call` numbers the campaigns of one test.
  Campaign(ExternalChecks* checks, std::function<void()> body, const ExploreOptions& options, std::uint32_t call);

  ExploreReport run();
  /// Runs only the schedule of `token`, which is that of the options.
  ExploreReport replay(const Token& token);

 private:
  bool begins_well();
  void search();
  void judge_default(const RunVerdict& verdict);
  bool has_failed() const;
  void look_for_leaks();
  std::string difference_to_the_first();
  /// `which`: the name of its schedule.
  void tell(const FailedRun& found, const std::string& which, const Token& token);
  void report_irreproducible(const FailedRun& found, const std::string& which);
  void write_finding(const std::string& file, FindingFile finding);
  RunVerdict play(const Token& token);
  std::string difference_to(const Token& token, const RunVerdict& verdict);
  std::string event_at(const Token& token, std::uint32_t decision);
  bool is_reproducible(const Finding& finding);
  Trail trail_of(const Finding& finding, std::uint32_t log_spacing);
  std::string replay_by(const Token& token, const Finding& finding);

  ExploreOptions options_;
  std::uint32_t call_;
  const std::string title_;    // of the test, or else the program
  const std::string command_;  // that reruns this program
  Body body_;
  BodyTarget target_;
  Profile profile_;
  Supervisor supervisor_;
  BodyRuns runs_;
  Discoveries discoveries_;
  const TimeLimit time_limit_;
  Search search_;
  std::uint64_t usual_digest_ = 0;  // of the first run, which is in the default order
  RunVerdict::Kind usual_kind_ = RunVerdict::Kind::passed;
  Timeline usual_;  // of the second one, which should be the same
  ExploreReport report_;
};

}  // namespace waitpoint::exploration
