// SPDX-License-Identifier: BSD-3-Clause
// Runs schedules of a target, several at once, each in its own process, until one fails or a limit is reached.
//
// Schedules have places, in the order in which they are started. When one fails, those of earlier places are awaited
// and later ones are killed: the reported failure is the first, regardless of the number of processes.
//
// Most schedules are drawn, each by its number. When draws bring nothing new (exploration::Exhaustion), an exhaustive
// strategy follows, one schedule at a time, since each is derived from the one before. Drawn ones whose plans do not
// wait for results are run in batches, which change neither places nor outcomes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "fibers/explore/schedules/exhaustion.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/explore/search/batches.hpp"
#include "tools/explore/search/discoveries.hpp"
#include "tools/explore/search/enumeration.hpp"
#include "tools/explore/search/feedback.hpp"
#include "tools/explore/search/results_file.hpp"
#include "tools/explore/search/search_progress.hpp"

namespace waitpoint::tools {

class Search {
 public:
  /// Tells `discoveries` of failed and racing runs, and `results`, unless it is null, of all: then failures do not end
  /// the search.
  Search(ProcessTarget& target, SearchProgress& progress, Discoveries& discoveries, ResultsFile* results);

  /// Runs the schedules that the options request.
  void run();

  std::uint64_t schedules() const { return schedules_; }
  std::uint64_t distinct() const { return orders_.size(); }
  std::uint64_t failures() const { return failures_; }
  /// Those that did not end the search, as they failed by a data race alone.
  std::uint64_t raced() const { return raced_; }
  /// The first one to accesses as switch points, in the order of the schedules.
  posix::AccessObstacle obstacle() const { return obstacle_; }
  bool interrupted() const { return interrupted_; }
  /// The scope of an exhausted search; nothing if it was not.
  const std::optional<std::string>& scope() const { return scope_; }
  /// The reason why all schedules have been tried, and there may be other orders; empty if that is not so.
  const std::string& unproved() const { return unproved_; }
  /// The strategy of the options draws: it was an enumeration that exhausted the search.
  bool has_drawn() const { return !is_exhaustive_; }

 private:
  /// How a schedule comes about.
  enum class Origin { drawn, enumerated };
  /// What is kept of an ended run, for `exhaustion_`.
  struct Ended {
    std::uint64_t order;
    bool is_enumerated, is_lost, was_cut, is_beyond;
  };

  bool has_time() const;
  bool may_start() const;
  std::optional<Origin> next_origin();
  void tell_exhaustion(std::uint64_t count);
  std::uint64_t next_drawn() const;
  bool learns(std::uint64_t number) const;
  bool start_next();
  bool start_left();
  bool start_drawn();
  bool start_learning();
  void start_enumerated();
  void start(const Batches::Batch& batch, const Plan& plan, const WantedEvidence& wanted);
  void take_ended(const Children::Ended& ended);
  void take(std::uint64_t place, ProcessFinding finding);
  void end_enumeration();
  void count(const ProcessFinding& finding);
  void report(bool at_end);

  ProcessTarget& target_;
  SearchProgress& progress_;
  Discoveries& discoveries_;
  ResultsFile* results_;
  Batches batches_;
  const bool reports_races_;
  std::uint64_t started_ = 0, drawn_ = 0;
  std::uint64_t schedules_ = 0, failures_ = 0, raced_ = 0;
  std::unordered_set<std::uint64_t> orders_;
  std::optional<std::uint64_t> failure_place_;  // of the failure that ends the search
  std::map<std::uint64_t, FailedRun> running_;  // by place, without their findings
  std::map<std::uint64_t, FailedRun> waiting_;  // ended before those of earlier places
  std::vector<Ended> ended_;                    // by place
  posix::AccessObstacle obstacle_ = posix::AccessObstacle::none;
  bool interrupted_ = false;

  std::optional<Feedback> feedback_;
  bool is_exhaustive_, may_be_exhausted_;
  exploration::Exhaustion exhaustion_;
  std::uint64_t told_ = 0;  // so many of `ended_` are told
  std::optional<Enumeration> enumeration_;
  std::optional<std::uint64_t> enumerating_;  // the place of its present or last schedule
  bool has_races_ = false;
  bool is_exhausted_ = false;
  std::string unproved_;
  std::optional<std::string> scope_;
};

}  // namespace waitpoint::tools
