// SPDX-License-Identifier: BSD-3-Clause
// The distinct data races of a campaign that goes on after them, each with the schedule that showed it first.
#pragma once

#include <string>
#include <vector>

#include "fibers/explore/races/distinct_races.hpp"

namespace waitpoint::exploration {

class RaceFindings {
 public:
  /// Takes the new races of the last run, by schedule `which`, and prints a line for each to standard error at once, as
  /// the process may end in a later schedule. `replay` is the command that repeats the run.
  void take(const std::string& which, const std::string& replay);

  /// Each race as text, with its schedule and its replay command, in the order in which they were found.
  std::vector<std::string> texts() const;
  /// Those that are not among `told`, as lines below a report; empty if there are none.
  std::string besides(const std::vector<races::Race>& told) const;

 private:
  struct Found {
    races::Race race;
    std::string which, replay;

    std::string text() const;
  };

  races::DistinctRaces distinct_;
  std::vector<Found> found_;
};

}  // namespace waitpoint::exploration
