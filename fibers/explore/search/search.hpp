// SPDX-License-Identifier: BSD-3-Clause
// Runs schedules of a target until one fails or a limit is reached, and counts their outcomes.
//
// Schedules have places, in the order in which they are started. When one fails, those of earlier places are awaited
// and later ones are killed: the reported failure is the first, regardless of how many are executed at once.
//
// Most schedules are drawn, each by its number. When draws bring nothing new (Exhaustion), an exhaustive strategy
// follows, one schedule at a time, since each is derived from the one before. Drawn ones whose plans do not wait for
// results are run in batches, which change neither places nor outcomes.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fibers/explore/schedules/exhaustion.hpp"
#include "fibers/explore/search/discoveries.hpp"
#include "fibers/explore/search/enumeration.hpp"
#include "fibers/explore/search/feedback.hpp"
#include "fibers/explore/search/pair_sample.hpp"
#include "fibers/explore/search/runner.hpp"
#include "fibers/explore/target/progress_listener.hpp"
#include "fibers/explore/target/time_limit.hpp"

namespace waitpoint::exploration {

/// The schedules of a search, beside those of the options.
struct SearchExtent {
  std::uint64_t first = 0, step = 1;  ///< the numbers of drawn ones
  std::uint64_t iterations = 0;       ///< all numbers are below
  bool may_be_exhausted = true;       ///< an enumeration may follow draws
  bool learns = false;                ///< feedback is kept here, not by the strategy that draws
  bool has_sample = false;            ///< the pairs of its sampled schedules come with them
  std::uint64_t decided_after = 0;    ///< see Search::next_origin()
  /// Called with each result; then failures do not end the search.
  std::function<void(std::uint64_t number, const Finding& finding)> each = {};
};

class Search {
 public:
  /// Failed and racing runs are passed to `discoveries`. `progress` may be null.
  Search(const ExploreOptions& options, SearchExtent extent, const TimeLimit& time_limit, Runner& runner,
         Discoveries& discoveries, ProgressListener* progress);

  /// Counts a run that has been executed before: the default order.
  void count_default(const RunVerdict& verdict);
  void run();

  std::uint64_t schedules() const { return schedules_; }
  /// Those that differ in more than the order of independent events.
  std::uint64_t distinct() const { return exhaustion_.distinct(); }
  std::uint64_t failures() const { return failures_; }
  /// Those that did not end the search, as they failed by a data race alone.
  std::uint64_t raced() const { return raced_; }
  /// The first one to accesses as switch points, in the order of the schedules.
  AccessObstacle obstacle() const { return obstacle_; }
  /// The most code that a schedule has made at run time, in bytes.
  std::uint64_t generated_code() const { return generated_code_; }
  /// The watched libraries that were loaded in a schedule: a bit for each.
  std::uint64_t libraries() const { return libraries_; }
  /// The scope of an exhausted search; nothing if it was not.
  const std::optional<std::string>& scope() const { return scope_; }
  /// The reason why all schedules have been tried, and there may be other orders; empty if that is not so.
  const std::string& unproved() const { return unproved_; }
  /// Exhausted, by schedules in which the program's accesses to memory were no switch points.
  bool is_exhausted_at_calls() const { return scope_ && enumeration_->is_at_calls(); }
  /// Of such a search: other orders may exist, for this reason.
  void doubt(std::string reason) {
    scope_.reset();
    unproved_ = std::move(reason);
  }
  /// Of such a search: an addition to its scope.
  void assume(const std::string& words) { *scope_ += words; }
  /// How much has been seen; nothing if there is no sample.
  std::optional<NewPairChance> chance_of_news() const { return sample_ ? sample_->chance() : std::nullopt; }
  /// The strategy of the options draws: it was an enumeration that exhausted the search.
  bool has_drawn() const { return !is_exhaustive_; }
  /// All schedules were tried, except spurious wake-ups.
  bool is_complete() const { return scope_ && enumeration_->is_complete(); }

 private:
  /// How a schedule comes about.
  enum class Origin { drawn, enumerated };
  /// A started schedule that is not counted yet.
  struct Open {
    std::uint64_t number;
    bool is_enumerated = false;
    const char* enumeration = nullptr;  // as in FailedRun
    Constraints constraints = {};
    std::unique_ptr<EndedSchedule> ended = {};  // before one of an earlier place
  };

  bool may_start() const;
  std::optional<Origin> next_origin() const;
  std::uint64_t next_drawn() const { return extent_.first + drawn_ * extent_.step; }
  bool learns(std::uint64_t number) const { return feedback_ && feedback_->is_learned(number); }
  bool start_next();
  bool start_drawn();
  bool start_learning();
  void start_enumerated();
  void begin_enumeration();
  void take(EndedSchedule& ended);
  void end_enumeration();
  void count(Open& open, EndedSchedule& ended);
  void count_first(EndedSchedule* ended);

  const ExploreOptions& options_;
  const SearchExtent extent_;
  const TimeLimit& time_limit_;
  Runner& runner_;
  Discoveries& discoveries_;
  ProgressListener* progress_;
  const bool reports_races_;
  std::uint64_t started_ = 0, drawn_ = 0;
  std::uint64_t counted_ = 0;  // places before this one are
  std::deque<Open> open_;      // from that place on
  std::uint64_t schedules_ = 0, failures_ = 0, raced_ = 0;
  std::optional<std::uint64_t> failure_place_;  // of the failure that ends the search
  AccessObstacle obstacle_ = AccessObstacle::none;
  std::uint64_t generated_code_ = 0, libraries_ = 0;

  std::optional<Feedback> feedback_;
  std::optional<PairSample> sample_;
  const bool is_exhaustive_;
  Exhaustion exhaustion_;
  std::optional<std::uint64_t> begun_after_;  // so many were counted when draws brought nothing new
  std::optional<Enumeration> enumeration_;
  bool has_races_ = false;
  bool is_exhausted_ = false;
  std::optional<std::string> scope_;
  std::string unproved_;
};

}  // namespace waitpoint::exploration
