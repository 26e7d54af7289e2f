// SPDX-License-Identifier: BSD-3-Clause
// What the library knows of the race runtime: a few functions by pointer, of a program that is linked with it. Plain
// records; races.hpp is what users and strategies read.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/shadow.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::races {

inline constexpr std::size_t calls_shown = 32;
/// Races that are kept of one run; each pair of places counts once.
inline constexpr std::size_t races_kept = 64;

/// One side of a race, with its calls, innermost first.
struct Side {
  MemoryAccess access;
  char task[kernel::name_size];
  std::uint32_t record;  ///< of the tasks of the run in the order of their making, counted from 1; 0: outside of them
  void* calls[calls_shown];
  std::size_t call_count;
};

struct FoundRace {
  Side first;  ///< in the order of this run
  Side second;
  std::uint64_t address;             ///< the lowest that both touch
  char stack_of[kernel::name_size];  ///< the task on whose stack that is; empty: on none
};

/// Who is told at once, from within a run, as its process may end at any time.
struct Listener {
  void (*found)(const FoundRace& race);
  void (*learned)(std::uint64_t place);  ///< of code that accesses what tasks share
};

struct Runtime {
  void (*begin_run)();
  std::size_t (*found)(const FoundRace*& races);
  void (*learn)(bool);
  void (*forget_learned)();
  void (*know)(std::uint64_t place);       ///< as if it had been learned
  void (*tell)(const Listener& listener);  ///< from now on; it must outlive the runs
};

}  // namespace waitpoint::races

/// Null where the program is not linked with waitpoint-races.
extern "C" __attribute__((weak)) const waitpoint::races::Runtime* waitpoint_races_runtime();
