// SPDX-License-Identifier: BSD-3-Clause
// Why accesses were no switch points of a program.
#pragma once

#include <string>

#include "fibers/posix/program/record.hpp"
#include "fibers/posix/traps/access_obstacle.hpp"

namespace waitpoint::tools {

/// The obstacles that the run has met.
posix::AccessObstacle obstacle_of(const posix::Record& record);
/// "the program handles SIGTRAP"; empty if there is nothing to say.
std::string words_of(posix::AccessObstacle obstacle);

}  // namespace waitpoint::tools
