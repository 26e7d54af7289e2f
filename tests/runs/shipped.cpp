// SPDX-License-Identifier: BSD-3-Clause
#include "tests/runs/shipped.hpp"

#include <cstdlib>

#include "modules/bridge/scenario_reader.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace fs = std::filesystem;

fs::path root() {
  if (const char* given = std::getenv("WAITPOINT_ROOT"); given != nullptr && *given != '\0') return given;
  for (const fs::path& start :
       {fs::read_symlink("/proc/self/exe"), fs::absolute(__FILE__).lexically_normal(), fs::current_path() / "."})
    for (fs::path folder = start.parent_path(); folder != folder.root_path(); folder = folder.parent_path())
      if (fs::exists(folder / "scenarios" / "office.yaml")) return folder;
  throw BadInput("WAITPOINT_ROOT", "the repository is not found: expected its folder");
}

bridge::Scenario shipped(const std::string& name, const std::vector<std::string>& assignments) {
  return bridge::read_scenario(root() / "scenarios" / name, assignments);
}

bridge::RunResult run(const bridge::Scenario& scenario, Duration until, std::uint64_t seed, kernel::Order order) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  bridge::Experiment experiment(scenario, types, {seed, order, ""});
  experiment.run_before(Time() + until);
  return experiment.result();
}

}  // namespace waitpoint::runs
