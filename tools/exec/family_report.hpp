// SPDX-License-Identifier: BSD-3-Clause
// The processes of a run, as the process that watches it sees them.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>

#include "core/digest.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/record.hpp"
#include "fibers/posix/reports/history.hpp"

namespace waitpoint::tools {

/// The shared memory of a part of the layer; null if they have used none.
const void* common_of(const posix::Record& record, posix::family::Part part);
/// The events and choices of all processes; null if none were asked for.
const posix::History* history_of(const posix::Record& record);
/// True if the run is of one process that has executed one program.
bool is_single(const posix::Record& record);
/// The digest of all processes.
Digest digest_of(const posix::Record& record);
/// Counts of all processes.
struct RunCounts {
  std::uint64_t processes = 1, threads = 0, threads_at_once = 0, events = 0, switches = 0;
  Time time;
};
RunCounts counts_in(const posix::Record& record);
/// "2 processes, 3 threads, 2 at once, 40 events, 12 switches, 0.5 s of virtual time".
std::string counts_of(const posix::Record& record);
/// After the end of the first process: waits for the others, and kills those that are left when the run is over.
/// At once, if `is_to_end` returns true.
void end_others(const posix::Record& record, const std::function<bool()>& is_to_end);

/// The memory that the processes of the run share.
posix::family::Family& family_of(const posix::Record& record);
/// The system's number of the process that has the turn; 0 if it is unknown.
pid_t process_in_turn(const posix::Record& record);
/// The number of events of all processes so far.
std::uint64_t events_of(const posix::Record& record);
/// The virtual time that the family has reached.
Time time_of(const posix::Record& record);
/// True if the first process handles the signal, or has blocked it.
bool is_caught(const posix::Record& record, int signal);
/// Kills all processes of the family.
void kill_all(const posix::Record& record);

}  // namespace waitpoint::tools
