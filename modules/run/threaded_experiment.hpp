// SPDX-License-Identifier: BSD-3-Clause
// One run of a scenario on threads of waitpoint::threads, without a Simulation. Compiled with WAITPOINT_REAL_THREADS
// the robots' software runs as on the robot, on threads of the system and the wall clock, with simulated hardware;
// otherwise it is the body of a simulated test.
//
//   the world's thread       at every multiple of the step: step; each robot's readings to posters, commands from them
//   a thread per robot       its executive
//   threads of its modules   control tasks and execution tasks, as the modules declare them
//
// A world delayed by the machine's load makes up its steps: its time is the clock's.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fibers/sync/threads.hpp"
#include "modules/run/assembly.hpp"

namespace waitpoint::run {

class ThreadedExperiment {
 public:
  /// Bad input of any kind is found here, as BadInput. The scenario must outlive the experiment. `make`: see Assembly;
  /// the step() of such a world waits for the step.
  ThreadedExperiment(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types, std::uint64_t seed,
                     const MakeWorld& make = nullptr);

  /// Runs once, until every robot with goals has ended its round, `limit` has passed, or `interrupted`, which is
  /// polled, returns true. Then stops every robot, ends its modules and joins all threads.
  void run_for(
      Duration limit, const std::function<bool()>& interrupted = [] { return false; });

  const world::World& world() const { return assembly_.world(); }
  const std::vector<std::unique_ptr<bridge::Robot>>& robots() const { return assembly_.robots(); }

  /// The result after the run, without digests and events. Dates are those of threads::now().
  bridge::RunResult result() const;

 private:
  bridge::Outcome wait_for_rounds(Time end, const std::function<bool()>& interrupted);
  void run_world();
  void exchange(Time date);

  Assembly assembly_;
  bool has_steps_of_its_own_;  // the world: elsewhere, so that its step() waits for them
  std::uint64_t seed_;
  bridge::Outcome outcome_ = bridge::Outcome::time_limit;
  Duration took_;
  threads::counting_semaphore<> round_ended_{0, "end of a robot's round"};
  threads::binary_semaphore world_ends_{0, "end of the world"};
};

}  // namespace waitpoint::run
