// SPDX-License-Identifier: BSD-3-Clause
// Runs of shipped scenarios with scripts.
#pragma once

#include <string>

#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::tcl {

inline std::string shipped(const std::string& name) { return (test::project_root() / "scenarios" / name).string(); }

inline bridge::RunResult result_of(const scenario::Scenario& scenario) {
  run::Experiment experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  experiment.run_before(Time() + scenario.until);
  return experiment.result();
}

}  // namespace waitpoint::tcl
