// SPDX-License-Identifier: BSD-3-Clause
// The data races of a run, of all processes whose program is compiled with -fsanitize=thread: logged as they are found,
// in the family's memory, so that the process that watches the run can report them however it ends.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fibers/explore/races/located_race.hpp"
#include "fibers/explore/strategies/memory_option.hpp"
#include "fibers/explore/strategies/switch_points.hpp"
#include "fibers/posix/traps/access_instruction.hpp"

namespace waitpoint::posix {

struct RaceOfProcess {
  pid_t process;        ///< its number in the family
  std::string program;  ///< as in other reports
  races::LocatedRace race;
};

/// family::Part::races.
struct RaceLog {
  std::vector<RaceOfProcess> races;
  std::vector<std::uint64_t> code;    ///< that accesses shared memory, if the run records it
  bool has_other_code = false;        ///< other code accesses shared memory than that of the earlier run
  bool has_left_out_values = false;   ///< in weak memory, a load was not offered a value that it may have returned
  bool has_lost_breakpoints = false;  ///< some were removed, as there were too many hits
  AccessObstacle obstacle = AccessObstacle::none;  ///< to breakpoints
  std::uint64_t libraries = 0;                     ///< with breakpoints: a bit for each that was asked for
};

/// True if this library is the one with the runtime, which instrumented programs load.
bool has_race_runtime();
/// The runtime takes its memory from these zeroed pages first.
void use_pages_for_races(void* zeroed, std::size_t bytes);
/// From now on races of this process are logged; and whether other code than `code` accesses shared memory, if that is
/// not recorded and `notes`. Called before the scheduler is made, where there is the runtime. Atomics have `memory`.
/// `code` comes from an earlier run.
void begin_race_log(bool learn, bool notes, Memory memory, std::span<const std::uint64_t> code);
/// The same for a program that is not instrumented, by breakpoints at these instructions: atomic operations that are
/// plain instructions cannot be told from others, so that no races are logged. `code` are places.
void begin_access_log(bool learn, bool notes, std::span<const AccessInstruction> instructions,
                      std::span<const AccessLibrary> libraries, std::span<const std::uint64_t> code);
/// The same without code: all conflicts are logged as races, atomic or not. Two accesses of which one is a write
/// conflict if no event, of a call, orders them.
void begin_conflict_log(std::span<const AccessInstruction> instructions, std::span<const AccessLibrary> libraries);

}  // namespace waitpoint::posix
