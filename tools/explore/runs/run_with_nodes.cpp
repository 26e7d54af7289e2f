// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/run_with_nodes.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "tools/nodes/simulated_nodes.hpp"
#include "tools/nodes/world_partner.hpp"

namespace waitpoint::tools {
namespace {

bool is_of_goals(const std::string& property) { return property.starts_with("goals_reached="); }

std::vector<std::string> words_of_run(const ExploreOptions& options, const scenario::Scenario& scenario) {
  std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe").string(), "run",
                                    options.scenario.string(), "--seed", std::to_string(options.seed)};
  const auto add = [&words](const char* option, const std::string& value) {
    words.emplace_back(option);
    words.push_back(value);
  };
  words.emplace_back("--brief");
  if (options.has_until()) add("--until", to_string(options.until));
  for (const std::string& assignment : options.assignments) add("--set", assignment);
  // A part of the run is not expected to reach all goals.
  const bool is_cut = options.limit(scenario.until) < Time() + scenario.until;
  if (is_cut && std::none_of(options.properties.begin(), options.properties.end(), is_of_goals))
    add("--set", "expect.goals_reached=");
  // What fails a program fails nodes, too.
  if (!scenario.expect.node_failures) add("--set", "expect.node_failures=0");
  if (!scenario.expect.service_call_max_s) add("--set", "expect.service_call_max_s=10");
  return words;
}

}  // namespace

ExploreOptions with_run_as_program(const ExploreOptions& options, const scenario::Scenario& scenario) {
  if (options.from) throw BadInput("--from", "cannot be used for a scenario with nodes");
  check_nodes(scenario);
  ExploreOptions all = options;
  all.has_nodes = true;
  all.program = words_of_run(options, scenario);
  all.conditions = conditions_of_nodes();
  all.switch_at = SwitchAt::calls;
  return all;
}

void tell_unmet(Finding& finding) {
  if (finding.kind != RunVerdict::Kind::unmet) return;
  constexpr std::string_view mark = "waitpoint: not as expected: ";
  std::string unmet;
  for (std::size_t at = finding.words.find(mark); at != std::string::npos; at = finding.words.find(mark, at)) {
    at += mark.size();
    unmet += (unmet.empty() ? "" : "; ") + finding.words.substr(at, finding.words.find('\n', at) - at);
  }
  if (!unmet.empty()) finding.words.replace(0, finding.words.find('\n'), unmet);
}

}  // namespace waitpoint::tools
