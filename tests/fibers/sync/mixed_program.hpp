// SPDX-License-Identifier: BSD-3-Clause
// A program in which tasks of some robots use every primitive in a random but fixed way: for tests of what must not
// depend on how a run is cut into windows, watched or repeated.
#pragma once

#include <cstdint>

#include "fibers/sync/simulation.hpp"

namespace waitpoint {

struct MixedProgram {
  std::uint64_t seed = 1;  ///< of what the tasks do
  int robots = 2;          ///< each with tasks of its own that share nothing with other robots'
  int rounds = 40;         ///< of each task
  bool with_timers = true;
};

/// Puts the program's tasks into `simulation`; the robots are named "r0", "r1", ...
void spawn_mixed_program(Simulation& simulation, const MixedProgram& program);

}  // namespace waitpoint
