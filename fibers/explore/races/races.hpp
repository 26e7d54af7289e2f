// SPDX-License-Identifier: BSD-3-Clause
// Data races of simulated threads: two unordered accesses to the same memory, one of them a write.
//
// They are found in code compiled with -fsanitize=thread and linked, without that flag, with waitpoint-races in place
// of waitpoint: a runtime of the library behind the compilers' instrumentation (g++ and clang++). Other programs find
// nothing, and pay nothing.
//
// Detection is by happens-before in one schedule (vector clocks), so a race is found even if it had no effect; races
// under another lock order need another schedule. Accesses to memory that tasks share and write concurrently are switch
// points, like the primitives.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace waitpoint::races {

struct LocatedRace;

/// One side of a race.
struct Access {
  std::string task;
  std::optional<std::uint32_t> number;  ///< the task's number in order of creation; none outside tasks
  std::uint64_t event = 0;              ///< number of events that its task had executed
  bool writes = false;
  bool atomic = false;
  std::size_t size = 0;            ///< bytes; 63 is "63 or more"
  std::vector<std::string> calls;  ///< "function at file:line", innermost first; of the user's code
  std::string line;                ///< "file:line" of the innermost one; else the address of the code
};

/// The lines of a race's accesses, the lesser one first.
using Lines = std::pair<std::string, std::string>;

struct Race {
  Access first;  ///< in the order of the run
  Access second;
  const void* address = nullptr;  ///< the lowest byte common to both
  std::string memory;             ///< its location: "global", "the stack of task NAME"; empty if unknown

  Lines lines() const { return std::minmax(first.line, second.line); }
};

/// "data race of the write at a.cpp:12 and the read at b.cpp:7 (global)".
std::string headline(const Race& race);

std::ostream& operator<<(std::ostream& out, const Race& race);

/// True if the program is linked with the runtime.
bool present();

/// Forgets the accesses and races of earlier runs. Each Simulation does this if there is no other; for those that use
/// one for several runs.
void begin_run();

/// True if the run found a race; costs nothing.
bool any_found();

/// The races of the run: each pair of source lines once per variable, of at most 64 pairs of accesses. Looks up names
/// and source lines: for reports.
std::vector<Race> found();

/// The same, for races of a process that may have ended.
std::vector<Race> in_words(std::span<const LocatedRace> races);

/// Controls whether later runs learn the code that accesses shared memory; such code is then a switch point also at its
/// task's first access to the memory. A run can only be repeated with the same learned code: learn in a first run in
/// the default order, and never after.
void learn(bool on);
void forget_learned();

/// Controls whether later runs note that other code than the learned accesses shared memory: its first accesses are not
/// switch points, so that an exhaustive search leaves schedules out.
void note_unlearned(bool on);
bool noted_unlearned();

/// Whether later runs have weak memory (weak_memory.hpp). Only explored runs return older values; needs the runtime.
void set_weak_memory(bool on);

/// Controls the note that a load was not offered a value that it may have returned, by the bounds of weak memory.
void forget_left_out_values();
bool left_out_values();

}  // namespace waitpoint::races
