// SPDX-License-Identifier: BSD-3-Clause
// A family: the processes that ever come of the program that was started, by fork and exec, and the memory that they
// share.
//
// They are one simulation (turn.hpp): at any time one of them runs, so what they share needs no lock. The memory is
// part of the run's file, behind the record, and mapped at the same address in every process.
#pragma once

#include <signal.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fibers/kernel/event.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/arena.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/family/account.hpp"
#include "fibers/posix/program/record.hpp"

namespace waitpoint::posix::family {

/// The parts of the layer with a state that the processes share.
enum class Part {
  names,
  futexes,
  semaphores,
  memory,
  messages,
  inside_files,
  schedule,
  files,
  ports,
  races,
  misuses,
  last_calls,
  history,
  air,
  chosen_ports,
  waits,
  count
};

inline constexpr int processes_max = 1024;
/// The number of the first process; the others count on, with their threads.
inline constexpr pid_t first_id = 1000;
/// The parent of a process whose parent has ended.
inline constexpr pid_t no_parent = 1;

/// What threads wait for, and what an action may have changed: a set.
using Changes = std::uint64_t;
inline constexpr Changes of_objects = Changes{1} << 63;  ///< shared primitives, System V objects
inline constexpr Changes of_descriptors = of_objects - 1;
inline constexpr Changes of_anything = of_objects | of_descriptors;
/// Subsets of the descriptors: sockets that listen, and a stream, by its pipe's inode or a number of its own.
inline constexpr Changes of_connecting = Changes{1} << 62;
inline constexpr Changes of_stream(std::uint64_t number) { return Changes{1} << (number % 62); }

/// A signal sent by another process.
struct Letter {
  siginfo_t information;
  pid_t thread = 0;  ///< its receiver; 0: the process
};

struct Process {
  enum class State : std::uint8_t {
    none,
    alive,
    stopped,
    ended,  ///< until its parent has taken note
  };
  State state = State::none;
  bool is_native = false;       ///< it executes a program that cannot be simulated
  bool borrows = false;         ///< made by vfork(): its parent waits until it executes a program
  bool continued = false;       ///< since its parent last took note
  bool is_unnoted = false;      ///< it was stopped since its parent last took note
  bool drops_children = false;  ///< it ignores SIGCHLD: its children leave no status
  pid_t id = 0;
  char name[kernel::name_size] = {};  ///< as its robot's: "sh", "sh#1003"; first of its parent's program
  pid_t parent = no_parent;
  pid_t group = 0, session = 0;
  std::atomic<pid_t> real_id = 0;  ///< of the system; 0 until it is known
  int status = 0;                  ///< of its end or stop, as waitpid() reports it
  int exit_status = 0;             ///< once it has called exit()
  std::uint64_t caught = 0;        ///< the signals that it handles or has blocked, a bit for each from 1 on

  // The turn (turn.hpp).
  kernel::EventKey next = kernel::EventKey::never();  ///< the key of its least event, while another has the turn
  std::atomic<std::uint32_t> has_turn = 0;            ///< a futex
  Changes listens_to = 0;                             ///< its threads wait for them
  bool executes = false;                              ///< another program, and keeps the turn
  bool is_chosen = false;                             ///< by the strategy: it executes the next event
  bool is_rung = false;                               ///< one of them did something since, first at `rung_at`
  Time rung_at;
  Changes rung_for = 0;  ///< what it may have changed
  bool waits_outside = false;
  bool has_partner = false;            ///< outside: virtual time waits for real time
  bool awaits_input = false;           ///< the same for descriptors alone
  bool awaits_outsiders = false;       ///< somebody who is not of the family may end one of these waits
  bool is_to_look = false;             ///< at the end of the instant: it acted on what its own threads wait for outside
  Time looked_at = Time::from_ns(-1);  ///< the instant at whose end it last looked outside
  std::uint64_t looked_after = 0;      ///< the family's actions until then

  // For the idle watch (exec/idle_watch.hpp): bytes written, as last read; those of the layer's own timers.
  std::uint64_t written = 0, written_by_timers = 0;
  pid_t waits_for = 0;  ///< the holder of a file lock; 0: none
  int letters = 0;
  static constexpr int letters_max = 32;
  Letter inbox[letters_max];
  PairDigest digest;  ///< of its events; the first process has its robot's
};

/// Entries are made at their first use: until then their memory is untouched, which a run of a millisecond notices.
class ProcessTable {
 public:
  ProcessTable() {}
  operator Process*() { return all_; }
  operator const Process*() const { return all_; }

 private:
  union {
    Process all_[processes_max];
  };
};

/// What the process adds to the family's digest, whether it has ended or not: a sum, as they end in any order.
inline std::uint64_t share_of_digest(pid_t process, const PairDigest& digest) {
  if (digest.pairs() == 0) return 0;
  Digest of_one;
  of_one.add(static_cast<std::uint64_t>(process));
  of_one.add(digest.value());
  return of_one.value();
}

/// Since the last known time at which a thread woke another: see exec/idle_watch.hpp.
struct Idleness {
  Time woken_at;
  Time acted_at;             ///< of the last event of a thread
  std::uint64_t events = 0;  ///< of threads and timers
};

/// The date of the system, as it is written to files that are changed now.
inline std::int64_t date_in_system_ns() {
  timespec date{};
  call_directly(SYS_clock_gettime, CLOCK_REALTIME_COARSE, reinterpret_cast<long>(&date));
  return date.tv_sec * std::int64_t{1'000'000'000} + date.tv_nsec;
}

/// A virtual time, and the real time that corresponds to it: see descriptors/pace.hpp.
struct Pace {
  bool has_begun = false;
  Time virtual_begin;
  std::int64_t real_begin_ns = 0;
};

struct alignas(Arena::alignment) Family {
  static constexpr std::uint64_t mark_of_version = 0x777066616D303034;  // "wpfam004"
  std::uint64_t mark = mark_of_version;
  Settings settings;
  RunFile file;
  Arena arena;
  void* parts[static_cast<int>(Part::count)] = {};
  Time now;                         ///< of the event now executing
  std::uint64_t settled_after = 0;  ///< the actions after which nothing came any more from sockets of the family
  std::uint64_t actions = 0;        ///< grows whenever a thread of any process has run, and when a process ends
  pid_t last_id = first_id - 1;
  std::uint32_t alive = 0;                                ///< number of processes that take turns
  std::uint32_t made = 0;                                 ///< number of all so far
  std::uint32_t entries = 0;                              ///< of the table, that were ever used
  std::int64_t began_in_system_ns = date_in_system_ns();  ///< files that were changed before are not the run's
  Time first_ended_at;                                    ///< the end of the first process
  bool is_over = false;     ///< no process can continue: each reports its threads, and ends
  bool is_cut_off = false;  ///< or those left over after the end of the first end without a report
  bool is_idle = false;     ///< or the idle limit was reached: each reports its threads
  bool is_reported = false;
  bool uses_futexes = false;         ///< a process, by itself: then its atomics order threads, and they are no events
  bool meets_outside = false;        ///< a process has waited for what is not simulated
  std::uint64_t generated_code = 0;  ///< see traps/generated_code.hpp; in bytes, of all processes
  std::atomic<std::uint32_t> holder = 0;  ///< the index of the process that has the turn
  std::atomic<pid_t> leaving = 0;  ///< the system's number of a process that has ended, as far as its own code goes
  std::uint64_t digest_of_ended = 0;
  std::uint64_t hand_overs = 0;
  std::uint32_t threads_made = 0;
  std::uint64_t events_of_ended = 0, switches_of_ended = 0;
  Account account;
  Idleness idleness;
  Pace pace;
  ProcessTable processes;
};

/// Null before the run.
extern Family* family;
/// The calling process; null before the run.
extern Process* own;

/// The entries of the table that are or were in use.
inline std::span<Process> entries_of(Family& all) {
  return {static_cast<Process*>(all.processes), std::min<std::size_t>(all.entries, processes_max)};
}
inline std::span<const Process> entries_of(const Family& all) {
  return {static_cast<const Process*>(all.processes), std::min<std::size_t>(all.entries, processes_max)};
}
inline std::span<Process> entries() { return entries_of(*family); }

/// Notes that a process waits by futexes of its own, or has waited for what is not simulated.
inline void note_own_futexes() {
  if (family != nullptr) family->uses_futexes = true;
}
inline void note_outside() {
  if (family != nullptr) family->meets_outside = true;
}

/// The shared state of a part, zeroed at the first call with a size; before that null.
void* common(Part part, std::size_t bytes);

/// Zeroed memory at the same address in all processes; null if exhausted.
void* take(std::size_t bytes);
void give(void* memory);
/// The same in whole pages, untouched; to be given back with the same size.
void* take_pages(std::size_t bytes);
void give_pages(void* pages, std::size_t bytes);

}  // namespace waitpoint::posix::family
