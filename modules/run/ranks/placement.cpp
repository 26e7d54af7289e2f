// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranks/placement.hpp"

#include <optional>

namespace waitpoint::run {

Placement::Placement(const scenario::Scenario& scenario, int rank, int ranks) : rank_(rank) {
  const std::size_t robots = scenario.robots.size();
  // Programs of one process share its objects, and those of a family its memory.
  std::optional<int> of_programs;
  for (std::size_t i = 0; i < robots; ++i) {
    const int own = static_cast<int>(i * static_cast<std::size_t>(ranks) / robots);
    const bool has_programs = !scenario.robots[i].programs.empty();
    if (has_programs && !of_programs) of_programs = own;
    rank_of_.push_back(has_programs ? *of_programs : own);
  }
}

}  // namespace waitpoint::run
