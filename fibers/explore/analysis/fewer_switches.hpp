// SPDX-License-Identifier: BSD-3-Clause
// Minimises the switches away from the default order of a failing schedule, within a budget: the rest is what matters.
//
// Switches are left out as long as the rest fails in the same way, with the same noise (leave_out.hpp). Then fewer ones
// elsewhere are tried: of a cheap target one in place of any two, and all schedules with one, then two; of another one,
// in a short run, all schedules with one. Finally the noise is left out, if possible.
#pragma once

#include <vector>

#include "fibers/explore/analysis/trials.hpp"

namespace waitpoint::exploration {

class FewerSwitches {
 public:
  /// Minimises the failure `found`, with the noise of schedule `number`.
  FewerSwitches(Trials& trials, std::uint64_t number, const Finding& found);

  void run();

  /// The minimal failing run: with this noise and these switches.
  const Finding& least() const { return least_; }
  std::uint64_t number() const { return number_; }
  /// True if the default order fails too.
  bool is_noise() const { return is_noise_; }
  /// True if the schedule repeats by its switches alone.
  bool repeats() const { return repeats_; }

 private:
  std::optional<Finding> tried(Plan plan, const WantedEvidence& wanted = {});
  std::optional<Finding> failing(const Plan& plan);
  bool fails(std::uint64_t number, const std::vector<Switch>& switches, std::size_t switches_max);
  void leave_out();
  bool leave_out_and_move(std::vector<Switch> others, const Switch& gone, std::size_t at);
  bool replace_two_by_one();
  bool replace(const std::vector<Switch>& others);
  bool search(const std::vector<Deviation>& before, std::size_t from, std::size_t count);

  Trials& trials_;
  std::uint64_t number_;
  Finding least_;
  Time until_;
  bool is_noise_ = false, repeats_ = false;
};

}  // namespace waitpoint::exploration
