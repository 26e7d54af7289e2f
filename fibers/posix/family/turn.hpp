// SPDX-License-Identifier: BSD-3-Clause
// The turn: one process of a family runs, the others sleep in the system. It hands over the turn to the process with
// the least event (order.hpp). A process that does something for which threads of another may wait rings it: the other
// then has an event at once, to check.
#pragma once

#include "fibers/kernel/task.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/processes.hpp"

namespace waitpoint::posix::family {

/// Starts a family with this process alone, at the beginning of a run, or joins the family of the process's parent as
/// the entry `index`: returns when it has the turn.
void begin();
void join(int index);
/// True if the process has joined a family that it did not begin.
bool is_joined();

/// Before a fork, by the running thread; null if there is no room.
Process* expect_child();
/// From now on it can be given the turn: the running thread makes it without a wait.
void let_begin(Process& child);
/// In the parent, with the child's number in the system; -1 if there is none.
void note_child(Process& child, pid_t real_id);
/// In the child: returns when it has the turn.
void begin_as_child(Process& child);

/// After a window: hands over the turn if the least event is another process's, and returns when the turn has come
/// back. False if the least event is its own, or nobody has one.
bool hand_over_if_due(kernel::Scheduler& scheduler);
/// Hands over the turn to this process, which a strategy has chosen or which waits for something outside; returns when
/// it has come back.
void hand_over_to(kernel::Scheduler& scheduler, Process& process);
/// What other processes that rang may have changed; then the run is at the present instant of the family. 0: none rang.
Changes take_ring(kernel::Scheduler& scheduler);

/// Called, unless null, before it leaves: what it has under way to other processes arrives.
extern void (*before_leaving)();
/// The process is about to end, with a status as of waitpid(): hands over the turn for good.
void leave(int status);
/// Ends another process; returns when that has happened.
void kill_at_once(Process& process);
/// The process has been stopped by the signal; returns when it is continued.
void stop(int signal);
/// Before the process executes a program that cannot be simulated: it no longer takes turns; or, if that has failed, it
/// does again.
void let_execute_natively(bool natively);

}  // namespace waitpoint::posix::family
