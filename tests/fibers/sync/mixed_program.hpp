// SPDX-License-Identifier: BSD-3-Clause
// A program in which the tasks of several robots use every primitive in a random but fixed way, for tests that windows,
// watches and repetition do not change a run.
#pragma once

#include <cstdint>

#include "fibers/sync/simulation.hpp"

namespace waitpoint {

struct MixedProgram {
  std::uint64_t seed = 1;  ///< of the tasks' actions
  int robots = 2;          ///< each with its own tasks, which share nothing with other robots'
  int rounds = 40;         ///< of each task
  bool with_timers = true;
};

/// Puts the program's tasks into `simulation`; the robots are named "r0", "r1", ...
void spawn_mixed_program(Simulation& simulation, const MixedProgram& program);

}  // namespace waitpoint
