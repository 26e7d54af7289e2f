// SPDX-License-Identifier: BSD-3-Clause
// Whether threads of a program share memory by calls alone: schedules in which its accesses to memory are observed.
//
// All orders of calls are all orders of a program only if whatever else its threads do commutes. So before it is said
// that no other ordering exists, some schedules are repeated, in the default order and in random ones, with breakpoints
// at all instructions of the program that access memory. Two threads' accesses to the same bytes, of which one is a
// write, that no event orders (vector clocks, as of data races) disprove it; atomic operations do so, too.
#pragma once

#include <cstdint>
#include <string>

#include "tools/explore/runs/target.hpp"

namespace waitpoint::tools {

struct ObservedAccesses {
  std::uint64_t schedules = 0;                     ///< observed ones
  std::string conflict;                            ///< of the first one that disproves it; empty if there is none
  AccessObstacle obstacle = AccessObstacle::none;  ///< to observing all
};

/// Runs a few schedules of a program that is not instrumented, or fewer if the time is over. One that fails disproves
/// it, too, if `all_passed` at calls.
ObservedAccesses observe_accesses(ProcessTarget& target, bool all_passed);

}  // namespace waitpoint::tools
