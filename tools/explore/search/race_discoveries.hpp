// SPDX-License-Identifier: BSD-3-Clause
// The distinct data races of a search, by their pairs of source lines, each with the schedule that showed it first.
#pragma once

#include <string>
#include <vector>

#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

class RaceDiscoveries {
 public:
  /// Takes the races that the run by schedule `which` tells of, and returns a line for each new one. `replay` is the
  /// command that repeats the run.
  std::vector<std::string> take(const Finding& finding, const std::string& which, const std::string& replay);

  /// Those that are not among `told`, as lines below a report.
  std::string besides(const std::vector<ToldRace>& told) const;

 private:
  struct Found {
    ToldRace race;
    std::string which, replay;
  };

  std::vector<Found> found_;
};

}  // namespace waitpoint::tools
