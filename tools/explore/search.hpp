// SPDX-License-Identifier: BSD-3-Clause
// Runs schedules of a target, several at once, each in its own process, until one fails or a limit is reached.
//
// Numbers are assigned in order. When a schedule fails, lower numbers are awaited and higher ones are killed: the
// reported failure is the one with the lowest number, regardless of the number of processes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_set>

#include "tools/explore/discoveries.hpp"
#include "tools/explore/exhaustive.hpp"
#include "tools/explore/results_file.hpp"
#include "tools/explore/search_progress.hpp"
#include "tools/explore/target.hpp"

namespace waitpoint::tools {

/// One run of the target in a process of its own; nothing if a signal to this process interrupted it.
std::optional<Finding> run_apart(Target& target, const Plan& plan, const Target::Request& request = {});

class Search {
 public:
  /// Tells `discoveries` of failed and racing runs, and `results`, unless it is null, of all: then failures do not end
  /// the search.
  Search(Target& target, SearchProgress& progress, Discoveries& discoveries, ResultsFile* results)
      : target_(target), progress_(progress), discoveries_(discoveries), results_(results) {}

  /// Runs the schedules that the options request.
  void run();

  std::uint64_t schedules() const { return schedules_; }
  std::uint64_t distinct() const { return digests_.size(); }
  std::uint64_t failures() const { return failures_; }
  /// Those that did not end the search, as they failed by a data race alone.
  std::uint64_t raced() const { return raced_; }
  bool interrupted() const { return interrupted_; }
  /// The scope of an exhausted search; nothing for strategies that are not exhaustive or did not finish.
  const std::optional<std::string>& scope() const { return scope_; }

 private:
  bool may_start() const;
  void take(std::uint64_t number, Finding finding);
  void report(bool at_end);
  void run_drawn();
  void run_exhaustively(Exhaustive& schedules);

  Target& target_;
  SearchProgress& progress_;
  Discoveries& discoveries_;
  ResultsFile* results_;
  std::uint64_t started_ = 0;
  std::uint64_t schedules_ = 0, failures_ = 0, raced_ = 0;
  std::unordered_set<std::uint64_t> digests_;
  std::optional<std::uint64_t> last_;         // the failure that ends the search
  std::uint64_t reported_ = 0;                // so many schedules are through, in the order of their numbers
  std::map<std::uint64_t, Finding> waiting_;  // ended before lower numbers
  bool interrupted_ = false;
  std::optional<std::string> scope_;
};

}  // namespace waitpoint::tools
