// SPDX-License-Identifier: BSD-3-Clause
// Reads documents as `waitpoint` does, many in one process: read-documents FOLDER < LINES.
//
// A line is KIND, a tab, and a document in one line: a scenario, or a file of robot types, a floor or a plan. For each
// a line is printed: "good", or what is wrong with it. FOLDER is for files that are written.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "modules/bridge/module_making.hpp"
#include "modules/executive/executive.hpp"
#include "modules/genom/task_computing.hpp"
#include "modules/plan/plan_reader.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/papers_modules.hpp"

namespace {

using namespace waitpoint;

/// Reads what only the modules and the executive know.
void read_settings(const scenario::RobotScenario& robot) {
  static const std::vector<genom::ModuleType> types = tools::shipped_modules();
  const auto map = std::make_shared<const OccupancyGrid>(1, 1, 1.0, Pose{});
  genom::NameSpace names;
  for (const std::string& name : robot.processors) names.add_processor(name);
  std::vector<std::unique_ptr<genom::Module>> modules;
  for (const scenario::ModuleScenario& module : robot.modules) {
    genom::ModuleSetup setup{names, module.name, genom::Settings(module.settings), nullptr, map};
    if (module.enabled) modules.push_back(bridge::make_module(module, types, robot.name, setup));
  }
  genom::Settings settings(robot.executive);
  executive::Parameters parameters;
  executive::read(settings, parameters);
  genom::read_computing(settings, "", names, {});
  settings.check_all_used();
  if (!robot.control) return;
  genom::Settings control(robot.control->settings);
  genom::read_computing(control, "", names, {});
  control.check_all_used();
  while (!modules.empty()) modules.pop_back();
}

void read(const std::string& kind, const std::filesystem::path& file) {
  if (kind == "plan") {
    plan::read_plan(scenario::load_yaml(file));
    return;
  }
  std::filesystem::path whole = file;
  if (kind != "scenario") {
    whole.replace_filename("whole.yaml");
    const std::string key = kind == "floor" ? "world" : "robot_types";
    std::ofstream(whole) << "format: 1\n"
                         << key << ": {include: " << file.filename().string() << "}\n"
                         << "robots: [{name: a, start: [1, 1], shape: {radius_m: 0.2, height_m: 1}}]\n";
  }
  const scenario::Scenario scenario = scenario::read_scenario(whole);
  for (const scenario::RobotScenario& robot : scenario.robots) read_settings(robot);
}

}  // namespace

int main(int, char** argv) {
  const std::filesystem::path file = std::filesystem::path(argv[1]) / "document.yaml";
  for (std::string line; std::getline(std::cin, line);) {
    const std::size_t tab = line.find('\t');
    std::ofstream(file) << line.substr(tab + 1) << '\n';
    try {
      read(line.substr(0, tab), file);
      std::cout << "good" << std::endl;
    } catch (const BadInput& error) {
      std::cout << error.what() << std::endl;
    }
  }
}
