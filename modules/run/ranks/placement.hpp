// SPDX-License-Identifier: BSD-3-Clause
// Which rank, a process of the run, has which robot's tasks.
#pragma once

#include <cstddef>
#include <vector>

#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

class Placement {
 public:
  /// All robots in one process.
  Placement() = default;
  /// Robots in the scenario's order are spread in equal parts, but all robots with programs share the rank of the first
  /// of them.
  Placement(const scenario::Scenario& scenario, int rank, int ranks);

  bool is_here(std::size_t robot) const { return rank_of_.empty() || rank_of_[robot] == rank_; }
  int rank_of(std::size_t robot) const { return rank_of_.empty() ? 0 : rank_of_[robot]; }

 private:
  std::vector<int> rank_of_;  // by robot; empty: all here
  int rank_ = 0;
};

}  // namespace waitpoint::run
