// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replayed_robot.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

using scenario::ModuleScenario;

const std::vector<std::string> localising = {"rflex", "sick", "segloc", "pom"};

scenario::RobotScenario robot_of_scenario(const std::filesystem::path& file) {
  const scenario::Scenario scenario = scenario::read_scenario(file);
  if (scenario.robots.empty()) throw BadInput(file.string(), "expected a robot, whose modules a log is replayed to");
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

void assign(scenario::RobotScenario& robot, const std::string& assignment) {
  const std::size_t dot = assignment.find('.'), equals = assignment.find('=');
  if (dot == assignment.npos || equals == assignment.npos || equals < dot)
    refuse("--set", "MODULE.KEY=VALUE", assignment);
  const std::string name = assignment.substr(0, dot), key = assignment.substr(dot + 1, equals - dot - 1);
  ModuleScenario* const module = find(robot, name);
  if (module == nullptr) refuse("--set", "the name of a module that runs, and a key of it", assignment);
  std::erase_if(module->settings, [&](const Setting& setting) { return setting.key == key; });
  module->settings.push_back({key, assignment.substr(equals + 1), "--set " + assignment, 0});
}

}  // namespace

scenario::RobotScenario replayed_robot(const LogOptions& options) {
  scenario::RobotScenario robot;
  robot.name = "robot";
  if (options.scenario) robot = robot_of_scenario(*options.scenario);
  if (!options.modules.empty()) {
    choose_modules(robot, options.modules);
  } else {
    std::vector<std::string> names;
    for (const std::string& name : localising)
      if (const ModuleScenario* const module = find(robot, name); module == nullptr || module->enabled)
        names.push_back(name);
    choose_modules(robot, names);
  }
  for (const std::string& assignment : options.assignments) assign(robot, assignment);
  return robot;
}

}  // namespace waitpoint::tools
