// SPDX-License-Identifier: BSD-3-Clause
// Minimises the switches away from the default order of a failing schedule, within a budget: the rest is what matters.
// Switches are left out as long as the rest fails in the same way, with the same noise
// (fibers/explore/schedules/leave_out.hpp); if several remain in a short run, a single switch elsewhere is tried
// instead; finally the noise is left out, if possible.
#pragma once

#include "tools/explore/report/budget.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/explore/search/search_progress.hpp"

namespace waitpoint::tools {

class FewerSwitches {
 public:
  /// Minimises the failure `found`, with the noise of schedule `number`.
  FewerSwitches(Target& target, SearchProgress& progress, Budget& budget, std::uint64_t number, const Finding& found);

  void run();

  /// The minimal failing run: with this noise and these switches.
  const Finding& least() const { return least_; }
  std::uint64_t number() const { return number_; }
  /// True if the default order fails too.
  bool is_noise() const { return is_noise_; }
  /// True if the schedule repeats by its switches alone; otherwise nothing could be left out.
  bool repeats() const { return repeats_; }

 private:
  bool fails(std::uint64_t number, const std::vector<exploration::Switch>& switches);
  /// The finding of that plan; nothing once the budget is exhausted.
  std::optional<Finding> tried(Plan plan);
  void leave_out();
  void seek_one();
  bool leave_out_and_move(std::vector<exploration::Switch> others, const exploration::Switch& gone, std::size_t at);

  Target& target_;
  SearchProgress& progress_;
  Budget& budget_;
  std::uint64_t number_;
  Finding least_;
  Time until_;
  bool is_noise_ = false, repeats_ = false, interrupted_ = false;
};

}  // namespace waitpoint::tools
