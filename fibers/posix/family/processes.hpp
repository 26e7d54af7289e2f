// SPDX-License-Identifier: BSD-3-Clause
// The table of a family's processes. The numbers that the programs see are the family's own, the same in every run.
#pragma once

#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix::family {

/// After the end of the first process the others continue, for at most so long.
inline constexpr Duration left_over_at_most = Duration(std::chrono::seconds(10));

/// The number of the calling process, without a system call.
pid_t this_process();
/// True if the process of this number, of the family or not, has not ended.
bool lives(pid_t process);

/// The process of this number, which may have ended; null if there is none.
Process* find(pid_t id);
/// A new process, child of the calling one; null if there is no room.
Process* add();
/// The process executes, or no longer, a program that cannot be simulated.
void set_native(Process& process, bool is_native);
/// True if the calling process has a child of that kind.
bool has_native_child();
/// True if any process of the family executes such a program: it may be at the other end of any pipe.
bool has_natives();
/// The process has executed another program: the family's digest keeps the events of the one before.
void keep_digest_of(const Process& process, const PairDigest& digest);
/// Removes an entry whose end was noted.
void remove(Process& process);
/// The system's number of a process of the family; other numbers stay as they are.
pid_t in_system(pid_t id);
/// The next number for a process or a thread.
pid_t next_id();

/// True in the process that was started first.
inline bool is_first() { return own == family->processes; }
/// The process has ended: its children have no parent from now on. `status` is as for waitpid().
void note_end_of(Process& process, int status);
/// Notes a stop or a continuation of the process, and notifies its parent.
void note_stop_of(Process& process, int signal);
void note_continuation_of(Process& process);
/// The entry of the process with this number in the system; null if there is none.
Process* find_in_system(pid_t system_id);
/// Sends a signal to another process; false if it has too many.
bool send_letter(Process& to, const siginfo_t& information, pid_t thread);

/// This process waits for a file lock of `holder`; with 0, for none. False if `holder` waits for this process, directly
/// or through others.
bool note_waiting_for(pid_t holder);

}  // namespace waitpoint::posix::family
