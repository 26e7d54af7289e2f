// SPDX-License-Identifier: BSD-3-Clause
// One call of explore(): runs schedules of one body until one fails or a limit is reached.
#pragma once

#include <memory>
#include <optional>

#include "fibers/explore/body.hpp"
#include "fibers/explore/body_target.hpp"
#include "fibers/explore/explore_options.hpp"
#include "fibers/explore/explore_report.hpp"
#include "fibers/explore/races/distinct_races.hpp"
#include "fibers/explore/report/finding_file.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/exhaustion.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/search/race_findings.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/explore/supervisor.hpp"

namespace waitpoint::exploration {

class Campaign {
 public:
  /// `call` numbers the campaigns of one test.
  Campaign(ExternalChecks* checks, std::function<void()> body, const ExploreOptions& options, std::uint32_t call);

  ExploreReport run();
  /// Runs only the schedule of `token`, which is that of the options.
  ExploreReport replay(const Token& token);

 private:
  struct Found {
    Finding finding;
    Schedule schedule;
    Token token;
    std::string which;                  // name of the schedule
    bool is_default = false;            // the default order
    const char* enumeration = nullptr;  // as in fails()
  };

  /// An exhaustive strategy that follows the campaign's own.
  struct Enumeration {
    const char* name;
    std::unique_ptr<Strategy> strategy = nullptr;
    std::uint64_t number = 0;  // of its next schedule

    explicit Enumeration(const char* of_strategy) : name(of_strategy) {}
  };

  bool begins_well();
  bool goes_on_after(const Found& found);
  void search();
  void look_for_leaks();
  bool fails(Strategy& strategy, std::uint64_t number, const char* enumeration);
  void begin_enumeration();
  bool enumerate();
  std::string difference_to_the_first();
  void set_scope(const Strategy& strategy, const std::string& what);
  void tell(const Found& found);
  void report_irreproducible(const Found& found);
  void write_finding(const std::string& file, FindingFile finding);
  RunVerdict play(const Token& token);
  std::string difference_to(const Token& token, const RunVerdict& verdict);
  std::string event_at(const Token& token, std::uint32_t decision);
  Found last_run(const RunVerdict& verdict) const;
  Token token_of(const Finding& finding) const;
  bool is_reproducible(const Finding& finding);
  std::string replay_command(const std::string& token) const;
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
  std::uint64_t usual_digest_ = 0;  // of the default schedule
  Timeline usual_;                  // its first run
  Exhaustion exhaustion_;
  std::optional<Enumeration> enumeration_;
  races::DistinctRaces new_races_;
  RaceFindings races_;
  std::optional<Found> first_race_;
  ExploreReport report_;
};

}  // namespace waitpoint::exploration
