// SPDX-License-Identifier: BSD-3-Clause
// Data races of simulated threads: two accesses to the same memory, one of them a write, that nothing orders.
//
// Found in code that is compiled with -fsanitize=thread and linked, without that flag, with waitpoint-races in place of
// waitpoint: a runtime of our own behind what the compiler inserts (g++ and clang++). In all other programs there is
// nothing to be found, and nothing is paid.
//
// Races are found by what happens before what in one schedule (vector clocks), so they are found in schedules in which
// they did no harm; what another order of locks would show takes another schedule. Accesses to memory that tasks share,
// and write while they do, are switch points there, beside the primitives.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace waitpoint::races {

struct LocatedRace;

/// One side of a race.
struct Access {
  std::string task;
  std::optional<std::uint32_t> number;  ///< the task's, in the order in which they were made; none outside of tasks
  std::uint64_t event = 0;              ///< how many events its task had executed
  bool writes = false;
  bool atomic = false;
  std::size_t size = 0;            ///< bytes; 63 is "63 or more"
  std::vector<std::string> calls;  ///< "function at file:line", innermost first; of the user's code
};

struct Race {
  Access first;  ///< in the order of the run
  Access second;
  const void* address = nullptr;  ///< the lowest byte of both
  std::string memory;             ///< where that is: "global", "the stack of task NAME"; empty where it is not known
};

std::ostream& operator<<(std::ostream& out, const Race& race);

/// Whether the program was linked with the runtime.
bool present();

/// Forgets the accesses and races of earlier runs. Each Simulation begins so when none other is there; for who uses one
/// for several runs.
void begin_run();

/// Whether the run found a race; costs nothing.
bool any_found();

/// The races of the run, for each variable each pair of source lines once, of at most 64 pairs of accesses. Looks for
/// names and source lines: for reports.
std::vector<Race> found();

/// The same of races in a process that may be gone.
std::vector<Race> in_words(std::span<const LocatedRace> races);

/// Whether runs from now on learn which code accesses what tasks share; such code is a switch point in later runs also
/// where its task is the first to touch the memory. A run that is to be repeated elsewhere must have learned the same:
/// learn in a first run in the default order, and no more.
void learn(bool on);
void forget_learned();

}  // namespace waitpoint::races
