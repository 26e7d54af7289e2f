// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/threaded_experiment.hpp"

#include <algorithm>

namespace waitpoint::run {
namespace {

constexpr Duration look_period = std::chrono::milliseconds(100);  // of polling `interrupted`

}  // namespace

ThreadedExperiment::ThreadedExperiment(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
                                       std::uint64_t seed, const MakeWorld& make)
    : assembly_(scenario, types, nullptr, seed, {}, make), has_steps_of_its_own_(make != nullptr), seed_(seed) {
  for (const scenario::RobotScenario& robot : scenario.robots) {
    if (!robot.programs.empty())
      throw robot.programs.front().written.bad(
          "expected no programs: they run only in virtual time, by `waitpoint run`");
    if (robot.nodes)
      throw robot.nodes->written.bad("expected no nodes of ROS: they run only in virtual time, by `waitpoint run`");
  }
}

void ThreadedExperiment::run_for(Duration limit, const std::function<bool()>& interrupted) {
  const Time start = threads::now();
  threads::thread world({.name = "world", .stack = kernel::StackSize::large}, [this] { run_world(); });
  std::vector<threads::thread> rounds;
  for (const auto& robot : robots())
    rounds.emplace_back(threads::thread_attributes{.name = robot->task_name(), .stack = kernel::StackSize::large},
                        [this, &robot] {
                          robot->run();
                          if (robot->has_mission()) round_ended_.release();
                        });
  outcome_ = wait_for_rounds(start + limit, interrupted);
  for (const auto& robot : robots()) robot->stop();
  for (threads::thread& round : rounds) round.join();
  std::vector<threads::thread> ends;
  for (const auto& robot : robots())
    ends.emplace_back(threads::thread_attributes{.name = "end"}, [&robot] { robot->end_modules(); });
  for (threads::thread& end : ends) end.join();
  world_ends_.release();
  world.join();
  took_ = threads::now() - start;
}

// Robots without goals or a plan never end by themselves.
bridge::Outcome ThreadedExperiment::wait_for_rounds(Time end, const std::function<bool()>& interrupted) {
  const auto with_mission =
      std::count_if(robots().begin(), robots().end(), [](auto& robot) { return robot->has_mission(); });
  for (std::ptrdiff_t ended = 0; ended < with_mission || with_mission == 0;) {
    if (interrupted()) return bridge::Outcome::interrupted;
    const Duration remaining = end - threads::now();
    if (remaining <= Duration()) return bridge::Outcome::time_limit;
    if (round_ended_.try_acquire_for(std::chrono::nanoseconds(std::min(remaining, look_period).ns()))) ++ended;
  }
  return bridge::Outcome::finished;
}

void ThreadedExperiment::run_world() {
  const Time start = threads::now();
  exchange(start);
  for (std::int64_t k = 1;; ++k) {
    const Time due = start + assembly_.scenario().step * k;
    if (world_ends_.try_acquire_for(std::chrono::nanoseconds((due - threads::now()).ns()))) return;
    assembly_.world().step();
    exchange(has_steps_of_its_own_ ? threads::now() : due);
  }
}

void ThreadedExperiment::exchange(Time date) {
  for (const auto& robot : robots()) {
    robot->bridge().exchange(date);
    robot->observe(date);
  }
}

bridge::RunResult ThreadedExperiment::result() const {
  bridge::RunResult result = assembly_.result();
  result.seed = seed_;
  result.outcome = outcome_;
  result.simulated = took_;
  return result;
}

}  // namespace waitpoint::run
