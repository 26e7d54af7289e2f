// SPDX-License-Identifier: BSD-3-Clause
// One run of a scenario by threads of waitpoint::threads alone: no Simulation drives it. Compiled with
// WAITPOINT_REAL_THREADS it is how the robots' software runs in reality, on the threads of the system and the wall
// clock, with only the hardware simulated; else it is the body of a simulated test.
//
//   thread of the world      at every multiple of its step: step; each robot's readings to posters, commands from them
//   thread of each robot     its executive
//   threads of its modules   as the modules declare them: control tasks and execution tasks
//
// A world that comes late, because the machine is loaded, makes up for it: its time is the clock's.
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
  /// Everything that can be wrong with the input is found here, as BadInput. The scenario must outlive the experiment.
  ThreadedExperiment(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types, std::uint64_t seed);

  /// Carries out the run, once: until every robot with goals has ended its round, for `limit` at most, or until
  /// `interrupted` says so, which is asked now and then. Then every robot is stopped, its modules are ended, and all
  /// threads have been joined.
  void run_for(
      Duration limit, const std::function<bool()>& interrupted = [] { return false; });

  const world::World& world() const { return assembly_.world(); }
  const std::vector<std::unique_ptr<bridge::Robot>>& robots() const { return assembly_.robots(); }

  /// What came out, after the run: without digests and events. Dates are those of
  /// threads::now().
  bridge::RunResult result() const;

 private:
  bridge::Outcome wait_for_rounds(Time end, const std::function<bool()>& interrupted);
  void run_world();
  void exchange(Time date);

  Assembly assembly_;
  std::uint64_t seed_;
  bridge::Outcome outcome_ = bridge::Outcome::time_limit;
  Duration took_;
  threads::counting_semaphore<> round_ended_{0, "end of a robot's round"};
  threads::binary_semaphore world_ends_{0, "end of the world"};
};

}  // namespace waitpoint::run
