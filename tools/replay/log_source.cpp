// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/log_source.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "modules/logs/log_file.hpp"
#include "modules/playback/log_settings.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

using scenario::ModuleScenario;

const std::vector<std::string> localising = {"rflex", "sick", "segloc", "pom"};

const scenario::RobotScenario& first_robot(const scenario::Scenario& scenario) {
  if (scenario.robots.empty()) throw BadInput(scenario.file, "expected a robot, whose modules a log is replayed to");
  return scenario.robots.front();
}

ModuleScenario* find(scenario::RobotScenario& robot, const std::string& name) {
  const auto found = std::find_if(robot.modules.begin(), robot.modules.end(),
                                  [&](const ModuleScenario& module) { return module.name == name; });
  return found != robot.modules.end() ? &*found : nullptr;
}

/// Keeps modules of these names only, and adds those that are not there with their own parameters.
void choose_modules(scenario::RobotScenario& robot, const std::vector<std::string>& names) {
  std::erase_if(robot.modules, [&](const ModuleScenario& module) {
    return std::find(names.begin(), names.end(), module.name) == names.end();
  });
  for (const std::string& name : names)
    if (find(robot, name) == nullptr)
      robot.modules.push_back({.name = name, .type = name, .settings = {}, .written = {"--modules", 0}});
}

/// A setting that is given for this log is not one that follows from it.
void check_not_of_log(const ModuleScenario& module, const Setting& setting) {
  const std::string said = playback::said_by_log(module.type, setting.key);
  if (!said.empty()) throw setting.bad("expected no " + setting.key + " of '" + module.name + "': " + said);
}

void assign(scenario::RobotScenario& robot, const std::string& assignment) {
  const std::size_t dot = assignment.find('.'), equals = assignment.find('=');
  if (dot == assignment.npos || equals == assignment.npos || equals < dot)
    refuse("--set", "MODULE.KEY=VALUE", assignment);
  const std::string name = assignment.substr(0, dot), key = assignment.substr(dot + 1, equals - dot - 1);
  ModuleScenario* const module = find(robot, name);
  if (module == nullptr) refuse("--set", "the name of a module that runs, and a key of it", assignment);
  std::erase_if(module->settings, [&](const Setting& setting) { return setting.key == key; });
  module->settings.push_back({key, assignment.substr(equals + 1), "--set " + assignment, 0});
  check_not_of_log(*module, module->settings.back());
}

/// Those of `names` that the robot does not switch off.
std::vector<std::string> not_disabled(scenario::RobotScenario& robot, std::vector<std::string> names) {
  std::erase_if(names, [&](const std::string& name) {
    const ModuleScenario* const module = find(robot, name);
    return module != nullptr && !module->enabled;
  });
  return names;
}

/// Replaces the values that `choice` has.
void choose(logs::LogChoice& choice, const logs::LogChoice& other) {
  const auto replace = [](std::string& name, std::string& place, const std::string& by, const std::string& by_place) {
    if (by.empty()) return;
    name = by;
    place = by_place;
  };
  replace(choice.scan, choice.scan_place, other.scan, other.scan_place);
  replace(choice.odometry, choice.odometry_place, other.odometry, other.odometry_place);
  replace(choice.robot, choice.robot_place, other.robot, other.robot_place);
}

}  // namespace

LogSource log_source(const scenario::Scenario& scenario) {
  WAITPOINT_CHECK(scenario.log && scenario.robots.size() == 1, "a scenario with a log has one robot");
  LogSource source{.file = scenario.log->file,
                   .choice = scenario.log->choice,
                   .laser = scenario.log->laser,
                   .until = {},
                   .robot = scenario.robots.front()};
  for (const ModuleScenario& module : source.robot.modules)
    for (const Setting& setting : module.settings)
      if (setting.line == 0 || setting.file == scenario.file) check_not_of_log(module, setting);
  if (scenario.until != Time::max().since_start()) source.until = scenario.until;
  if (source.robot.modules.empty()) choose_modules(source.robot, localising);
  return source;
}

LogSource log_source(const LogOptions& options) {
  LogSource source;
  source.robot.name = "robot";
  source.robot.written = {"--modules", 0};
  std::optional<scenario::Scenario> scenario;
  if (options.scenario) scenario = scenario::read_scenario(*options.scenario);
  const bool has_log = scenario && scenario->log;
  if (has_log)
    source = log_source(*scenario);
  else if (scenario)
    source.robot = first_robot(*scenario);
  source.file = options.log;
  choose(source.choice, options.choice);
  if (!options.modules.empty()) {
    choose_modules(source.robot, options.modules);
    source.robot.written = {"--modules", 0};
  } else if (!has_log) {
    choose_modules(source.robot, not_disabled(source.robot, localising));
  }
  for (const std::string& assignment : options.assignments) assign(source.robot, assignment);
  return source;
}

Time LogSource::end(std::optional<Duration> given) const {
  const std::optional<Duration> limit = given ? given : until;
  return limit ? Time() + *limit : Time::max();
}

logs::SensorLog LogSource::read() const {
  logs::SensorLog log = logs::read_log(file, choice);
  logs::apply(laser, log);
  return log;
}

}  // namespace waitpoint::tools
