// SPDX-License-Identifier: BSD-3-Clause
// The data races of a program's run.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fibers/explore/races/located_race.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// Of one process.
struct RacesOf {
  std::string process;  ///< "worker#1002"; empty if the run had one process
  std::vector<races::Race> races;
};

std::vector<RacesOf> races_by_process(const posix::Record& record);
/// Several lines for each: two accesses and their source locations; if the run had several processes, by process.
/// Empty without races.
std::string races_of(const posix::Record& record);
bool has_races(const posix::Record& record);
/// True if other code than that of an earlier run accesses shared memory, if the run notes it.
bool has_unlearned_code(const posix::Record& record);
/// True if, in weak memory, a load was not offered a value that it may have returned.
bool has_left_out_values(const posix::Record& record);
/// Some accesses were not seen, as there were too many.
bool has_lost_breakpoints(const posix::Record& record);
/// All races as they were found, without the names of source lines.
std::vector<races::LocatedRace> located_races(const posix::Record& record);
/// The code that accesses shared memory, if the run recorded it.
std::span<const std::uint64_t> code_of(const posix::Record& record);

}  // namespace waitpoint::tools
