// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/file_list.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/playback/playback.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/nodes/node_commands.hpp"
#include "tools/output/json_document.hpp"
#include "tools/replay/log_source.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

void add_files(std::string& text, Json& json) {
  json["files"] = Json::array();
  for (const ListedFile& file : FileList::files()) {
    text += fmt::format("  {:<9} {}\n", to_string(file.use), printable_line(file.name));
    json["files"].push_back({{"use", to_string(file.use)}, {"name", file.name}});
  }
}

int tell_good(const CheckOptions& options, std::string text, Json json) {
  if (options.files) add_files(text, json);
  write_text(text, options.json);
  return options.json ? end_with_json("check", 0, json.dump(-1, ' ', false, Json::error_handler_t::replace)) : 0;
}

/// Looks for the programs of nodes, which are started by a run alone. A warning for one that is not there.
void list_programs_of_nodes(const scenario::Scenario& scenario, std::vector<std::string>& warnings) {
  try {
    (void)node_commands(scenario);
  } catch (const BadInput& missing) {
    warnings.emplace_back(missing.what());
  }
}

int check_log(const CheckOptions& options, const scenario::Scenario& scenario,
              std::span<const genom::ModuleType> types) {
  const LogSource source = log_source(scenario);
  const logs::SensorLog log = source.read();
  const playback::Playback playback(log, source.robot, types, {});
  const std::string text =
      fmt::format("{}: good: {}, {} of {}\n", printable_line(scenario.file), counted(playback.modules(), "module"),
                  counted(log.scans.size(), "scan"), printable_line(log.file));
  return tell_good(options, text,
                   {{"scenario", scenario.file},
                    {"modules", playback.modules()},
                    {"log", log.file},
                    {"scans", log.scans.size()},
                    {"warnings", Json::array()}});
}

}  // namespace

void declare(Command& command, CheckOptions& options) {
  command.description = "Validates a scenario without running it.";
  command.examples = {"office --set world.step_ms=5"};
  declare_scenario(command, options);
  command.section("Results");
  command.add("--files", flag(options.files), "list the files that it reads, executes or writes (docs/trust.md)");
  command.json(options.json);
}

int check(const CheckOptions& options, std::span<const genom::ModuleType> types) {
  const scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments, options.allowed);
  begin_with_program_layer(scenario);
  const RunWatchdog watchdog(RunWatchdog::usual_limit_s);
  if (scenario.log) return check_log(options, scenario, types);
  const run::Experiment experiment(scenario, types, {});
  confine_to_listed_files();
  std::size_t modules = 0, goals = 0;
  for (const scenario::RobotScenario& robot : scenario.robots) {
    goals += robot.goals.size();
    for (const scenario::ModuleScenario& module : robot.modules) modules += module.enabled ? 1 : 0;
  }
  const std::size_t obstacles = experiment.world().description().obstacles.size();
  std::string text = fmt::format("{}: good: {}, {}, {}, {}\n", printable_line(options.scenario.string()),
                                 counted(scenario.robots.size(), "robot"), counted(modules, "module"),
                                 counted(goals, "goal"), counted(obstacles, "obstacle"));
  std::vector<std::string> plans;
  for (const auto& robot : experiment.robots())
    if (const std::string plan = robot->plan_text(); !plan.empty()) plans.push_back(plan);
  for (const std::string& plan : plans) text += plan + "\n";
  std::vector<std::string> warnings = experiment.result().warnings;
  if (options.files) list_programs_of_nodes(scenario, warnings);
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  return tell_good(options, text,
                   {{"scenario", options.scenario.string()},
                    {"robots", scenario.robots.size()},
                    {"modules", modules},
                    {"goals", goals},
                    {"obstacles", obstacles},
                    {"plans", plans},
                    {"warnings", warnings}});
}

}  // namespace waitpoint::tools
