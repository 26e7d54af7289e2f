// SPDX-License-Identifier: BSD-3-Clause
#include "tests/runs/shipped.hpp"

#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {

scenario::Scenario shipped(const std::string& name, const std::vector<std::string>& assignments) {
  return scenario::read_scenario(test::project_root() / "scenarios" / name, assignments);
}

bridge::RunResult run(const scenario::Scenario& scenario, Duration until, std::uint64_t seed, kernel::Order order) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  run::Experiment experiment(scenario, types, {seed, order, ""});
  for (const auto& robot : experiment.robots()) robot->keep_paths();
  experiment.run_before(Time() + until);
  return experiment.result();
}

}  // namespace waitpoint::runs
