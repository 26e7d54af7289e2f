// SPDX-License-Identifier: BSD-3-Clause
// waitpoint::main() of the build on system threads: the same scenarios and modules, at the wall clock's speed.
#include <atomic>
#include <cstdio>
#include <memory>

#include "modules/outside/remote_world.hpp"
#include "modules/run/expectation.hpp"
#include "modules/run/threaded_experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/manual_page.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/options/schedule.hpp"
#include "tools/command/options/time_limits.hpp"
#include "tools/command/version.hpp"
#include "tools/main.hpp"
#include "tools/output/output_file.hpp"
#include "tools/papers_modules.hpp"
#include "tools/tcl_library.hpp"

namespace waitpoint::tools {
namespace {

struct Arguments {
  std::string scenario;
  std::vector<std::string> assignments;
  std::uint64_t seed = 1;
  std::optional<Duration> until;
  std::string world;
};

/// The world of another process, at this address; the scenario's own if it is empty.
run::MakeWorld world_at(const std::string& address, const scenario::Scenario& scenario, std::atomic<bool>& ended) {
  if (address.empty()) return nullptr;
  const outside::Endpoint endpoint = outside::parse_endpoint(address, "--world");
  return [&, endpoint](const world::WorldDescription& description) {
    return std::make_unique<outside::RemoteWorld>(scenario, description, endpoint, "--world", ended);
  };
}

void print(const bridge::RunResult& result) {
  const bridge::RunTotals sum = totals(result);
  std::printf("%s: %s after %.1f s on real threads\n\n", result.scenario.c_str(),
              std::string(to_string(result.outcome)).c_str(), result.simulated.seconds());
  if (sum.goals > 0) std::printf("  goals reached     %zu of %zu\n", sum.goals_reached, sum.goals);
  if (sum.present.motion) {
    std::printf("  distance driven   %.1f m\n", sum.distance_m);
    std::printf("  collisions        %llu\n", static_cast<unsigned long long>(sum.collisions));
  }
  if (sum.present.position)
    std::printf("  position error    mean %.3f m, greatest %.3f m\n", sum.position_error_mean_m,
                sum.position_error_max_m);
  for (const bridge::RobotResult& robot : result.robots)
    for (const bridge::GoalResult& goal : robot.goals)
      if (!goal.reached())
        std::printf("  %s: goal at (%.2f, %.2f): %s\n", robot.name.c_str(), goal.position.x, goal.position.y,
                    goal.report.empty() ? "not reached" : goal.report.c_str());
  for (const bridge::RobotResult& robot : result.robots) {
    if (!robot.plan) continue;
    std::printf("\n  %s: plan '%s' %s\n", robot.name.c_str(), robot.plan->name.c_str(), robot.plan->end.c_str());
    for (const std::string& line : robot.plan->log) std::printf("    %s\n", line.c_str());
  }
  for (const std::string& warning : result.warnings) std::printf("warning: %s\n", warning.c_str());
}

int run(const Arguments& arguments, std::span<const genom::ModuleType> types) {
  const scenario::Scenario scenario = scenario::read_scenario(arguments.scenario, arguments.assignments);
  std::atomic<bool> world_ended = false;
  run::ThreadedExperiment experiment(scenario, types, arguments.seed, world_at(arguments.world, scenario, world_ended));
  heed_signals();
  experiment.run_for(arguments.until.value_or(scenario.until), [&] { return interruption() != 0 || world_ended; });
  const bridge::RunResult result = experiment.result();
  print(result);
  flush_standard_output();
  if (world_ended) return 1;
  if (result.outcome == bridge::Outcome::interrupted) return 130;
  const std::vector<std::string> unmet = run::unmet(scenario.expect, result);
  for (const std::string& line : unmet) std::fprintf(stderr, "waitpoint: not as expected: %s\n", line.c_str());
  return unmet.empty() ? 0 : 1;
}

int read_and_run(int argc, const char* const* argv, std::span<const genom::ModuleType> types) {
  CommandLine line("waitpoint-native", "Runs robots' software on system threads, against a simulated world.",
                   version_text(), version_json);
  line.program().own.examples = {"run office.yaml --until 60"};
  line.program().own.notes =
      "COMMAND --help tells more. Exit status: 0 as the scenario expects, 1 not so, 2 bad input.";
  Arguments arguments;
  Command& command = line.program().add("run");
  command.description = "Runs a scenario at the wall clock's speed.";
  command.examples = {"office.yaml --until 60"};
  command.add("SCENARIO", text(arguments.scenario, ""), "the scenario file", {.is_required = true});
  command.add("--set", texts(arguments.assignments, "KEY=VALUE"), "override a value of the scenario; may be repeated");
  declare_seed(command, arguments.seed, "seed of the world's noise");
  declare_until(command, arguments.until);
  command.section("Processes");
  command.add("--world", text(arguments.world, "unix:PATH|tcp:PORT"),
              "drive the robots in the world of another process, which serves it there",
              {.more = "waitpoint run --serve-world (docs/external.md)."});
  std::string page;
  add_manual(line.program(), page);
  line.parse(argc, argv);
  if (line.text() || line.given() != &command) {
    write_standard_output(line.text() ? *line.text() : manual_page(line.program(), page));
    return 0;
  }
  return run(arguments, types);
}

}  // namespace
}  // namespace waitpoint::tools

namespace waitpoint {

int main(int argc, const char* const* argv, std::vector<genom::ModuleType> own) {
  // Of two types of one name the first counts.
  std::vector<genom::ModuleType> types = std::move(own);
  for (genom::ModuleType& type : tools::shipped_modules()) types.push_back(std::move(type));
  tools::find_tcl();
  tools::prefer_errors_to_signals();
  try {
    return tools::read_and_run(argc, argv, types);
  } catch (const BadInput& error) {
    std::fprintf(stderr, "waitpoint: %s\n", error.what());
    return 2;
  }
}

}  // namespace waitpoint
