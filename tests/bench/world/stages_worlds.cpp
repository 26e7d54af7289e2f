// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/bench/kernel/meter.hpp"
#include "tests/bench/world/crowds.hpp"
#include "tests/project.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::bench {
namespace {

scenario::Scenario scenario_of(const std::string& world, const std::string& data) {
  const std::filesystem::path file = test::project_root() / "tests/bench/world" / (world + ".yaml");
  return scenario::read_scenario(file, {"world.map=" + data + "/stage/benchmark/" + world + ".world"});
}

// The file has its second thousand as comments: the first, moved 59 m east.
void add_second_thousand(scenario::Scenario& scenario) {
  const std::vector<scenario::RobotScenario> first = scenario.robots;
  for (scenario::RobotScenario robot : first) {
    robot.name += "_east";
    robot.body.name = robot.name;
    robot.body.start.x += 59;
    scenario.robots.push_back(std::move(robot));
  }
}

void measure(const scenario::Scenario& scenario, const std::string& name, Duration simulated, int repeats, Limit must,
             Limit aim, Figures& figures) {
  const std::vector<genom::ModuleType> types = tools::shipped_modules();
  double best = 0, distance_m = 0;
  for (int i = 0; i < repeats; ++i) {
    run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
    const std::int64_t from = clock_ns(Clock::processor);
    experiment.run_before(Time() + simulated);
    best = std::max(best, simulated.seconds() / (1e-9 * static_cast<double>(clock_ns(Clock::processor) - from)));
    distance_m = 0;
    for (const bridge::RobotResult& robot : experiment.result().robots) distance_m += robot.distance_m;
  }
  const auto robots = static_cast<double>(scenario.robots.size());
  figures.add({fmt::format("{}, {} robots", name, robots), "waitpoint", best, "times real time", {}, must, aim});
  figures.add({fmt::format("{}, {} robots", name, robots), "waitpoint", distance_m / robots, "m each"});
}

// The folder of Stage's files; nothing, with a message, without them.
std::optional<std::string> stages_files() {
  std::optional<std::string> data = test::data_folder();
  if (!data) fmt::print("left out, for there is no data folder (set WAITPOINT_DATA): a world of Stage's\n");
  return data;
}

constexpr int repeats(bool quick) { return quick ? 2 : 5; }

}  // namespace

using namespace std::chrono_literals;

void stages_cave(bool quick, Figures& figures) {
  if (const auto data = stages_files())
    measure(scenario_of("cave", *data), "Stage's cave", quick ? 20s : 60s, repeats(quick), {50}, {90}, figures);
}

void stages_hospital(bool quick, Figures& figures) {
  const auto data = stages_files();
  if (!data) return;
  scenario::Scenario hospital = scenario_of("hospital", *data);
  add_second_thousand(hospital);
  measure(hospital, "Stage's hospital", quick ? 5s : 20s, repeats(quick), {20}, {40}, figures);
}

}  // namespace waitpoint::bench
