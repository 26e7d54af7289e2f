// SPDX-License-Identifier: BSD-3-Clause
// The library's interface to the race runtime: function pointers, set in a program that is linked with it. Plain
// records; races.hpp is for users and strategies.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/shadow.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::races {

inline constexpr std::size_t calls_shown = 32;
/// The greatest number of races stored per run; each pair of places counts once.
inline constexpr std::size_t races_kept = 64;

/// One side of a race, with its calls, innermost first.
struct Side {
  MemoryAccess access;
  char task[kernel::name_size];
  std::uint32_t record;  ///< number of the run's tasks in order of creation, counted from 1; 0: outside tasks
  void* calls[calls_shown];
  std::size_t call_count;
};

struct FoundRace {
  Side first;  ///< in the order of this run
  Side second;
  std::uint64_t address;             ///< the lowest common byte
  char stack_of[kernel::name_size];  ///< the task whose stack contains it; empty: none
};

/// Callbacks for immediate notification from within a run, as its process may end at any time.
struct Listener {
  void (*found)(const FoundRace& race);
  void (*learned)(std::uint64_t place);  ///< a new place of code that accesses shared memory
  void (*unlearned)();                   ///< the first such place of a run that only notes them
  void (*left_out_value)();              ///< a load was not offered a value that it may have returned: once a run
};

/// A store that a load may read.
struct ReadableStore {
  std::uint64_t value;
  std::uint64_t place;           ///< its code; 0: the value before the first atomic access
  char task[kernel::name_size];  ///< that made it
  std::uint32_t record;          ///< as in Side
  int order;                     ///< of the load
};

struct Runtime {
  void (*begin_run)();
  std::size_t (*found)(const FoundRace*& races);
  void (*learn)(bool);
  void (*forget_learned)();
  void (*know)(std::uint64_t place);       ///< adds a place, as if learned
  void (*tell)(const Listener& listener);  ///< sets the listener; it must outlive the runs
  /// Code outside of tasks is the simulator's own from now on: it orders events only by order_by_outside(). Otherwise
  /// all that tasks did happens before what is done outside, and that before all that tasks do later.
  void (*set_outside_apart)();
  void (*order_by_outside)();
  void (*note_unlearned)(bool);
  /// An access by code that is not instrumented, the next instruction of the running task.
  void (*accessed)(std::uint64_t address, std::uint32_t size, bool writes, bool is_atomic, std::uint64_t place);
  bool (*noted_unlearned)();
  void (*set_weak)(bool);  ///< whether later runs have weak memory: weak_memory.hpp
  /// During a choice of the value of a load: the store with `newer` newer ones.
  ReadableStore (*readable_store)(std::uint32_t newer);
  bool (*left_out_values)();  ///< a load was not offered a value that it may have returned
  void (*forget_left_out_values)();
  void (*use_pages)(void* zeroed, std::size_t bytes);  ///< takes its memory from there first
};

}  // namespace waitpoint::races

/// Null if the program is not linked with waitpoint-races.
extern "C" __attribute__((weak)) const waitpoint::races::Runtime* waitpoint_races_runtime();
