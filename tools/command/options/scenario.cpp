// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/scenario.hpp"

#include "tools/command/installed_part.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

OptionValue scenario_file(std::filesystem::path& into) {
  OptionValue value{.file = OptionValue::File::read};
  value.take = [&into](const std::string&, const std::string& text) { into = find_scenario(text); };
  value.files = [](const std::string& text) { return std::vector{find_scenario(text).string()}; };
  return value;
}

/// The scenario's own folder, then those of --allow.
void confine(ScenarioOptions& options) {
  if (!options.is_confined) return;
  options.confined_to = {options.scenario.has_parent_path() ? options.scenario.parent_path() : "."};
  options.confined_to.insert(options.confined_to.end(), options.allowed.begin(), options.allowed.end());
}

}  // namespace

void declare_scenario(Command& command, ScenarioOptions& options, ScenarioArgument argument) {
  command.add("SCENARIO", scenario_file(options.scenario),
              "its file, or the name of a shipped one (waitpoint scenarios)",
              {.is_required = argument == ScenarioArgument::required});
  command.section("Scenario");
  command.add("--set", texts(options.assignments, "KEY=VALUE"), "override a value of the scenario; may be repeated",
              {.more = "KEY is keys joined by dots, elements of lists by their index from 0 or their name; VALUE is "
                       "YAML. A file named here is relative to the current directory. For example:\n"
                       "  robots.0.goals=[[1,2],[3,4]]\n"
                       "  robot_types.rackham.modules.segloc.enabled=false"});
  command.add("--confined", flag(options.is_confined),
              "for a stranger's scenario: files in its own folder and below it alone, and no programs (docs/trust.md)",
              {.is_rare = true});
  command.add("--allow", texts(options.allowed, "FOLDER"),
              "files of FOLDER, too: for scripts, and with --confined for all; may be repeated", {.is_rare = true});
  command.finally([&options] { confine(options); });
}

}  // namespace waitpoint::tools
