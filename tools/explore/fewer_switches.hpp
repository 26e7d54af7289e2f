// SPDX-License-Identifier: BSD-3-Clause
// A failing schedule of a target with as few switches away from the default order as a budget finds: what is left is
// what matters. Switches are left out as long as the rest fails in the same way, with the same noise
// (fibers/explore/schedules/leave_out.hpp); where several are left of a short run, one at another place may do the work
// of all; and at last the noise is left out too, if it can be.
#pragma once

#include "tools/explore/budget.hpp"
#include "tools/explore/search.hpp"

namespace waitpoint::tools {

class FewerSwitches {
 public:
  /// Of what failed as `found` with the noise of schedule `number`.
  FewerSwitches(Target& target, SearchProgress& progress, Budget& budget, std::uint64_t number, const Finding& found);

  void run();

  /// The least that fails alike: of these numbers' noise, with these switches.
  const Finding& least() const { return least_; }
  std::uint64_t number() const { return number_; }
  /// The default order fails too.
  bool is_noise() const { return is_noise_; }
  /// Whether the schedule repeats by its switches alone; else nothing could be left out.
  bool repeats() const { return repeats_; }

 private:
  bool fails(std::uint64_t number, const std::vector<exploration::Switch>& switches);
  /// What that plan comes to; nothing where the effort is at its end.
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
