// SPDX-License-Identifier: BSD-3-Clause
// What `waitpoint exec` and the program that it runs share: a file in memory that both map, at one address.
//
// The digest and the scheduler's counts are kept in it, and where its schedule is explored that too, so that they are
// known up to the last event however the program ends, killed or not.
#pragma once

#include <cstdint>
#include <new>
#include <span>

#include "core/digest.hpp"
#include "fibers/clocks/clock_options.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/posix/base/arena.hpp"

namespace waitpoint::posix {

/// The environment variable with the number of its descriptor.
inline constexpr char record_variable[] = "WAITPOINT_EXEC";

/// Exit statuses of a simulated program that are not its own.
inline constexpr int status_of_deadlock = 124, status_of_own_errors = 125;

/// Where the file is mapped: in no program is anything else there. Its pages are taken as they are used.
inline constexpr std::uintptr_t record_address = 0x2a00'0000'0000;
inline constexpr std::size_t record_bytes = std::size_t{1} << 34;

struct Asked;
struct Explored;
struct RaceLog;
struct Trace;

struct Settings {
  kernel::Order order = kernel::Order::seeded;
  std::uint64_t seed = 1;
  Time until = Time::max();  ///< the run is cut off then
  bool has_clock = false;    ///< threads have a clock; else computing takes no time
  kernel::ClockOptions clock;
  bool isolate = false;             ///< what leaves the machine is forbidden
  bool trap_rdtsc = false;          ///< reading the processor's counter shows virtual time
  bool traced = false;              ///< all events are written down
  const Asked* asked = nullptr;     ///< how the schedule is explored, in Order::explored
  std::uint32_t looks_at_once = 1;  ///< so many uses of clocks and of giving way are paid for together
  bool instrumented = false;        ///< the program is compiled with -fsanitize=thread
  bool trap_library = false;        ///< what the C library waits for within itself is simulated
  bool simulates_started = false;   ///< programs that are started are simulations too
  bool is_started = false;          ///< this is one of those
  int server = -1;                  ///< a socket: runs are asked for there, see fork_server.hpp
};

/// How a run ended that did not end as the program would have.
enum class Ending : std::uint8_t { own, deadlock, no_progress, cut_off };

/// One of several programs in one process.
struct ProgramRecord {
  char name[kernel::name_size] = {};
  std::uint32_t place = 0;  ///< on the command line, from 0
  // Written by the program.
  kernel::Robot robot;
  std::uint32_t threads_made = 0;
  bool ended = false;
  int status = 0;  ///< its exit status, once it has ended
};

struct Record {
  static constexpr std::uint64_t mark_of_version = 0x7770657865633034;  // "wpexec04"

  std::uint64_t mark = mark_of_version;
  Settings settings;
  /// Where the process is several programs, they: in the order of their names. None: it is one program.
  ProgramRecord* programs = nullptr;
  std::uint32_t program_count = 0;

  // Written by the program.
  bool began = false;  ///< the scheduler is there
  Ending ending = Ending::own;
  Explored* explored = nullptr;
  Trace* trace = nullptr;
  RaceLog* race_log = nullptr;  ///< of an instrumented program
  Arena arena;                  ///< behind this record
  std::uint32_t threads_made = 0;
  std::uint32_t threads_most = 0;          ///< at once
  kernel::Task* const* running = nullptr;  ///< in the program: where it keeps its running task
  kernel::Robot robot;                     ///< the program, where it is the only one
  union {
    kernel::Scheduler scheduler;
  };

  Digest digest() const {
    if (program_count == 0) return robot.digest.digest();
    Digest all;
    for (const ProgramRecord& program : several()) all.add(program.robot.digest.value());
    return all;
  }
  std::span<ProgramRecord> several() const { return {programs, program_count}; }

  /// Wherever it is made, it is to be used at the record's address.
  Record() {
    arena.start(reinterpret_cast<Record*>(record_address) + 1, reinterpret_cast<char*>(record_address + record_bytes));
  }
  ~Record() {}  // the scheduler is never taken down: the process ends around it
};

}  // namespace waitpoint::posix
