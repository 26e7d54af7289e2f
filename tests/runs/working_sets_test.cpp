// SPDX-License-Identifier: BSD-3-Clause
// The memory that tasks declare for prefetching is their own, a few kilobytes each: more of it would displace what
// other tasks need next.
#include <gtest/gtest.h>

#include "fibers/kernel/run.hpp"
#include "modules/run/experiment.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

std::size_t lines_of(const kernel::Task& task) {
  std::size_t lines = 0;
  for (std::uint32_t i = 0; i < task.working_set_size; ++i) lines += task.working_set[i].count;
  return lines;
}

TEST(WorkingSets, TasksHaveSmallOnes) {
  constexpr std::size_t lines_max = 128;
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const scenario::Scenario scenario = shipped("office-10.yaml");
  run::Experiment experiment(scenario, types, {usual_seed, kernel::Order::fifo, ""});
  experiment.run_before(Time() + std::chrono::seconds(1));
  int declared = 0;
  for (const kernel::Task* task = kernel::roster(experiment.simulation().scheduler()).first_task(); task != nullptr;
       task = task->next) {
    if (task->working_set_size > 0) ++declared;
    EXPECT_LE(lines_of(*task), lines_max) << task->robot->name << " " << task->name;
  }
  EXPECT_GE(declared, 6 * 10);  // a bridge and the tasks of five modules for each robot
}

}  // namespace
}  // namespace waitpoint::runs
