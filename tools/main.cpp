// SPDX-License-Identifier: BSD-3-Clause
#include "tools/main.hpp"

#include <cstdio>

#include "modules/bridge/experiment.hpp"
#include "modules/bridge/scenario_reader.hpp"
#include "modules/ndd/ndd.hpp"
#include "modules/pom/pom.hpp"
#include "modules/rflex/rflex.hpp"
#include "modules/segloc/segloc.hpp"
#include "modules/sick/sick.hpp"
#include "tools/options.hpp"
#include "tools/run.hpp"
#include "tools/version.hpp"

namespace waitpoint {
namespace {

std::vector<genom::ModuleType> with_papers_modules(std::vector<genom::ModuleType> types) {
  // The first of a name counts.
  types.push_back(genom::module_type<ndd::Ndd>("ndd"));
  types.push_back(genom::module_type<pom::Pom>("pom"));
  types.push_back(genom::module_type<rflex::Rflex>("rflex"));
  types.push_back(genom::module_type<segloc::Segloc>("segloc"));
  types.push_back(genom::module_type<sick::Sick>("sick"));
  return types;
}

int check(const tools::CheckOptions& options, std::span<const genom::ModuleType> types) {
  const bridge::Scenario scenario = bridge::read_scenario(options.scenario, options.assignments);
  const bridge::Experiment experiment(scenario, types, {});
  std::size_t modules = 0;
  for (const bridge::RobotScenario& robot : scenario.robots)
    for (const bridge::ModuleScenario& module : robot.modules) modules += module.enabled ? 1 : 0;
  std::printf("%s: good: %zu robots, %zu modules, %zu goals, %zu obstacles\n", options.scenario.c_str(),
              scenario.robots.size(), modules, experiment.goals(), experiment.world().description().obstacles.size());
  return 0;
}

}  // namespace

int main(int argc, const char* const* argv, std::vector<genom::ModuleType> own) {
  const std::vector<genom::ModuleType> types = with_papers_modules(std::move(own));
  try {
    const tools::Options options = tools::read_options(argc, argv, tools::version_text());
    if (const auto* run = std::get_if<tools::RunOptions>(&options)) return tools::run(*run, types);
    if (const auto* checked = std::get_if<tools::CheckOptions>(&options)) return check(*checked, types);
    std::fputs(std::get<tools::ShownText>(options).text.c_str(), stdout);
    return 0;
  } catch (const BadInput& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "waitpoint: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "waitpoint: the run failed: %s\n", error.what());
    return 1;
  }
}

}  // namespace waitpoint
