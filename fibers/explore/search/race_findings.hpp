// SPDX-License-Identifier: BSD-3-Clause
// The distinct data races of a search, by their pairs of source lines, each with the schedule that showed it first.
#pragma once

#include <string>
#include <vector>

#include "fibers/explore/target/finding.hpp"

namespace waitpoint::exploration {

class RaceFindings {
 public:
  /// Takes the races of the run by schedule `which`, and returns a line for each new one. `replay` is the command that
  /// repeats the run.
  std::vector<std::string> take(const std::vector<ToldRace>& races, const std::string& which,
                                const std::string& replay);

  /// Each race as text, with its schedule and its replay command, in the order in which they were found.
  std::vector<std::string> texts() const;
  /// Those that are not among `told`, as lines below a report.
  std::string besides(const std::vector<ToldRace>& told) const;

 private:
  struct Found {
    ToldRace race;
    std::string which, replay;

    std::string text() const { return which + ": " + race.text + "replay: " + replay; }
  };

  std::vector<Found> found_;
};

}  // namespace waitpoint::exploration
