// SPDX-License-Identifier: BSD-3-Clause
// Why accesses were no switch points of a program.
#pragma once

#include <cstdint>
#include <string>

#include "fibers/explore/strategies/switch_points.hpp"
#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// The obstacles that the run has met.
AccessObstacle obstacle_of(const posix::Record& record);
/// The libraries whose accesses were switch points: a bit for each that is watched, the lowest for the first.
std::uint64_t watched_libraries_of(const posix::Record& record);
/// "the program handles SIGTRAP"; empty if there is nothing to say.
std::string words_of(AccessObstacle obstacle);

}  // namespace waitpoint::tools
