// SPDX-License-Identifier: BSD-3-Clause
#include "tools/main.hpp"

#include <cstdio>
#include <string_view>

#include "core/printable_line.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/post_mortem.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/check/self_check.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/exec/exec.hpp"
#include "tools/exec/program_process.hpp"
#include "tools/explore/explore.hpp"
#include "tools/gdb/debug.hpp"
#include "tools/options.hpp"
#include "tools/papers_modules.hpp"
#include "tools/run/run.hpp"
#include "tools/version.hpp"

namespace waitpoint {
namespace {

int check(const tools::CheckOptions& options, std::span<const genom::ModuleType> types) {
  const scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments);
  tools::begin_with_program_layer(scenario);
  kernel::set_post_mortem(sync::write_call_stack);
  const run::Experiment experiment(scenario, types, {});
  std::size_t modules = 0;
  for (const scenario::RobotScenario& robot : scenario.robots)
    for (const scenario::ModuleScenario& module : robot.modules) modules += module.enabled ? 1 : 0;
  std::printf("%s: good: %zu robots, %zu modules, %zu goals, %zu obstacles\n", options.scenario.c_str(),
              scenario.robots.size(), modules, experiment.goals(), experiment.world().description().obstacles.size());
  for (const std::string& warning : experiment.result().warnings) std::printf("warning: %s\n", warning.c_str());
  return 0;
}

}  // namespace

int main(int argc, const char* const* argv, std::vector<genom::ModuleType> own) {
  // Of two types of one name the first counts.
  std::vector<genom::ModuleType> types = std::move(own);
  for (genom::ModuleType& type : tools::shipped_modules()) types.push_back(std::move(type));
  const kernel::FaultReports reports(nullptr);  // also of constructors; once for all windows of a run
  try {
    const tools::Options options = tools::read_options(argc, argv, tools::version_text());
    if (const auto* run = std::get_if<tools::RunOptions>(&options))
      return run->check ? tools::self_check(*run, types) : tools::run(*run, types);
    if (const auto* checked = std::get_if<tools::CheckOptions>(&options)) return check(*checked, types);
    if (const auto* debug = std::get_if<tools::DebugOptions>(&options)) tools::debug(*debug);
    if (const auto* executed = std::get_if<tools::ExecOptions>(&options)) return tools::exec(*executed);
    if (const auto* explored = std::get_if<tools::ExploreOptions>(&options)) return tools::explore(*explored, types);
    std::fputs(std::get<tools::ShownText>(options).text.c_str(), stdout);
    return 0;
  } catch (const BadInput& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "waitpoint: %s\n", error.what());
    // Every other status may be the program's own.
    const bool is_exec = argc > 1 && std::string_view(argv[1]) == "exec";
    return is_exec ? tools::exec_failed : 2;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "waitpoint: the run failed: %s\n", printable_message(error.what()).c_str());
    return 1;
  }
}

}  // namespace waitpoint
