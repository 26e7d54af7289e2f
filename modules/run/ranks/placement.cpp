// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranks/placement.hpp"

#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"

namespace waitpoint::run {
namespace {

std::size_t robot_named(const scenario::Scenario& scenario, std::string_view name) {
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    if (scenario.robots[i].name == name) return i;
    known.push_back(scenario.robots[i].name);
  }
  throw BadInput("--place", "there is no robot '" + std::string(name) + "'" + did_you_mean(name, known));
}

}  // namespace

Placement::Placement(const scenario::Scenario& scenario, int rank, int ranks, std::span<const std::string> given)
    : rank_(rank) {
  const std::size_t robots = scenario.robots.size();
  for (std::size_t i = 0; i < robots; ++i)
    rank_of_.push_back(static_cast<int>(i * static_cast<std::size_t>(ranks) / robots));
  std::vector<bool> is_given(robots);
  for (const std::string& each : given) {
    const std::size_t equals = each.rfind('=');
    int wanted = -1;
    if (equals == std::string::npos || !parse_number(std::string_view(each).substr(equals + 1), wanted) || wanted < 0 ||
        wanted >= ranks)
      throw BadInput("--place", "expected ROBOT=RANK with a rank from 0 to " + std::to_string(ranks - 1) + ", found '" +
                                    each + "'");
    const std::size_t robot = robot_named(scenario, std::string_view(each).substr(0, equals));
    rank_of_[robot] = wanted;
    is_given[robot] = true;
  }
  // Programs of one process share its objects, and those of a family its memory.
  std::optional<int> of_programs;
  for (const bool given_ones : {true, false})
    for (std::size_t i = 0; i < robots; ++i) {
      if (scenario.robots[i].programs.empty() || is_given[i] != given_ones) continue;
      if (!of_programs) of_programs = rank_of_[i];
      if (is_given[i] && rank_of_[i] != *of_programs)
        throw BadInput("--place", "expected robots with programs on one rank, found robot '" + scenario.robots[i].name +
                                      "' on rank " + std::to_string(rank_of_[i]) + ", another on rank " +
                                      std::to_string(*of_programs));
      rank_of_[i] = *of_programs;
    }
}

}  // namespace waitpoint::run
