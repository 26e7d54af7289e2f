// SPDX-License-Identifier: BSD-3-Clause
// The memory shared by `waitpoint exec` and the program that it runs: a memory file mapped by both at one address.
//
// It holds the digest, the scheduler's counters and, in an exploration, the schedule, so that they are known up to the
// last event however the program ends, even if it is killed.
#pragma once

#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "fibers/clocks/clock_options.hpp"
#include "fibers/kernel/chooser.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/arena.hpp"

namespace waitpoint::posix {

/// The environment variable with the file's descriptor number.
inline constexpr char record_variable[] = "WAITPOINT_EXEC";
/// The name that a session gives to a program, in place of that of its file.
inline constexpr char name_variable[] = "WAITPOINT_NAME";

/// A clock of the program's own, and of what it starts, in place of the run's (fibers/clocks/clock_text.hpp).
inline constexpr char clock_variable[] = "WAITPOINT_CLOCK";

/// Exit statuses set by the layer, not by the program.
inline constexpr int status_of_deadlock = 124, status_of_own_errors = 125;

/// The file's address, which no program uses. Its pages are allocated on first use.
/// A scheduler fits into it (exec/run.cpp).
inline constexpr std::size_t scheduler_bytes = 2048;
inline constexpr std::uintptr_t record_address = 0x2a00'0000'0000;
inline constexpr std::size_t record_bytes = std::size_t{1} << 34;

/// Behind it, in the same file: the memory that the processes of the program share (family/family.hpp).
inline constexpr std::uintptr_t family_address = record_address + record_bytes;
inline constexpr std::size_t family_bytes = std::size_t{1} << 34;
inline constexpr std::size_t run_bytes = record_bytes + family_bytes;

/// The last page of the record's memory, which outlasts the run: see reruns/rerun_control.hpp.
inline constexpr std::size_t control_bytes = 4096;
inline constexpr std::uintptr_t control_address = family_address - control_bytes;

/// The file, as the processes that execute another program open it: a descriptor of the process that watches the run.
struct RunFile {
  int watcher = 0;  ///< process
  int descriptor = -1;
};

struct Asked;
struct Explored;
class HistoryRecorder;

/// Of UDP datagrams between the processes: see links/datagram_medium.hpp.
struct Medium {
  double loss = 0;  ///< probability, from 0 to 1
  Duration delay_least, delay_greatest;
  bool is_declared() const { return loss > 0 || delay_greatest > Duration(); }
};

struct Settings {
  kernel::Order order = kernel::Order::seeded;
  std::uint64_t seed = 1;
  Time until = Time::max();  ///< the run is cut off then
  bool has_clock = false;    ///< threads have a clock; else computing takes no time
  kernel::ClockOptions clock;
  bool isolate = false;                               ///< traffic beyond this machine is rejected
  bool trap_rdtsc = false;                            ///< reading the processor's counter shows virtual time
  bool traced = false;                                ///< all events are recorded
  bool fast_paths = true;                             ///< see SimulationOptions::fast_paths
  const Asked* asked = nullptr;                       ///< the exploration's request, in Order::explored
  std::uint32_t looks_at_once = 1;                    ///< uses of clocks and of sched_yield() that are charged together
  std::uint32_t batches_at_once = 1;                  ///< the same for batches of uses of primitives: see waiting.hpp
  Duration call_cost = std::chrono::nanoseconds(50);  ///< of a use of a primitive, and of reading a clock
  double speed = 1;  ///< of virtual time by real time, with partners outside; 0: it does not wait
  Duration idle_limit = std::chrono::hours(1);  ///< 0: none; see exec/idle_watch.hpp
  bool strict = false;                          ///< what does not repeat ends the run
  bool trap_library = false;                    ///< waits within the C library are simulated
  bool simulates_started = false;               ///< programs that it starts are simulations too
  bool reports_ending = false;                  ///< the watching process ends the run when a signal asks to
  bool makes_reruns = false;                    ///< see reruns/rerun.hpp
  bool own_machine = false;                     ///< see exec/own_machine.hpp
  Medium medium;
  int server = -1;  ///< a socket on which runs are requested, see fork_server.hpp
};

/// How a run ended: `own` as the program ends by itself.
enum class Ending : std::uint8_t { own, deadlock, no_progress, idle, cut_off };

struct alignas(64) Record {
  static constexpr std::uint64_t mark_of_version = 0x7770657865633039;  // "wpexec09"

  std::uint64_t mark = mark_of_version;
  Settings settings;
  RunFile file;

  // Written by the program.
  bool began = false;  ///< the scheduler exists
  Ending ending = Ending::own;
  Explored* explored = nullptr;
  HistoryRecorder* recorder = nullptr;  ///< if events are asked for
  Arena arena;                          ///< the rest of the file, behind this record
  std::uint32_t threads_made = 0;
  std::uint32_t threads_most = 0;  ///< at once
  kernel::Robot robot;
  /// The scheduler, which is never destroyed: the process ends first.
  alignas(64) std::byte scheduler_memory[scheduler_bytes];

  kernel::Scheduler& scheduler() { return *reinterpret_cast<kernel::Scheduler*>(scheduler_memory); }
  const kernel::Scheduler& scheduler() const { return *reinterpret_cast<const kernel::Scheduler*>(scheduler_memory); }
  Digest digest() const { return robot.digest.digest(); }

  /// Its pointers are valid at the record's address, wherever it is constructed.
  Record() { arena.start(reinterpret_cast<Record*>(record_address) + 1, reinterpret_cast<char*>(control_address)); }
};
static_assert(record_address % 4096 == 0 && record_bytes % 4096 == 0, "the record's file is mapped in whole pages");
static_assert(sizeof(Record) % Arena::alignment == 0, "the arena begins behind the record");
static_assert(std::is_trivially_copyable_v<Settings> && std::is_trivially_copyable_v<Arena>,
              "a fork copies the record bytewise");

}  // namespace waitpoint::posix
