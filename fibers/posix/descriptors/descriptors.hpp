// SPDX-License-Identifier: BSD-3-Clause
// Waiting for descriptors. What is behind them is real (pipes, sockets, files), so that dup, fork and exec keep
// working; only who waits, for how long and in which order is simulated: a call that would block its thread waits here
// until the descriptor is ready, and is made then.
//
// A descriptor is inside as long as only this program has its ends: then it becomes ready by what a thread of this
// program does, and is looked at when one has done something. All others are outside: whether something has come there
// depends on the real time, so that they are looked at only when no thread can go on at the present instant, and waited
// for in real time only when none can at all.
#pragma once

#include <poll.h>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

struct Program;

/// Threads that wait now: they are ready when the system says so of any of their descriptors.
bool anybody_waits_outside();

/// Descriptors from this on are taken for outside ones.
inline constexpr int known_descriptors_max = 65536;
/// A descriptor was made by this program for itself, or is another name of such a one; it is closed.
void note_inside(int descriptor, bool inside);
bool is_inside(int descriptor);
/// The running program has it from now on.
void note_owner(int descriptor);
/// The first descriptor from `from` on that a program shares with the process's others, and whose it is; -1 without
/// one.
int next_owned(int from, const Program*& owner);
/// It is no program's any more.
void disown(int descriptor);
/// A child has copies of all of them: nothing is inside any more. Nor is what threads wait for on shared objects.
void note_fork();
/// The same of a program that is started: it has no copies of those that are closed then.
void note_start();
/// In the child: nobody waits there.
void forget_waiters();
/// The task is not there any more.
void forget_waiter(const kernel::Task& task);

/// The running thread waits until any of the descriptors is ready or `deadline` comes. As poll(): how many are, which
/// is in their `revents`; 0 at the deadline, or if the thread was cancelled; -1 with EINTR if a signal ended the wait.
/// Where all are inside it goes on at once if one is ready.
int wait_for(pollfd* descriptors, nfds_t count, Time deadline, Restart restart);
/// For one descriptor.
int wait_for(int descriptor, short events, Time deadline, Restart restart);

/// While it lives, the running thread waits for something outside that is no descriptor: a signal.
class WaitsOutside {
 public:
  WaitsOutside();
  ~WaitsOutside();
  WaitsOutside(const WaitsOutside&) = delete;
  WaitsOutside& operator=(const WaitsOutside&) = delete;
};

/// Waits in real time until `descriptor` can be written, and lets no other thread go on meanwhile; false if it cannot
/// after so long.
bool wait_for_reader(int descriptor, int patience_ms);

/// Called before each look at descriptors; null: not. A reader may have made room for what is on its way to it.
extern void (*before_look)();
/// Something was done with a descriptor that others may wait for.
void look_at_descriptors();

/// The running thread waits for something outside that is no descriptor, until `is_ready` says so: 1; 0 if the thread
/// was cancelled; -1 with EINTR if a signal ended the wait.
int wait_outside(bool (*is_ready)(const void*), const void* what, Restart restart);

/// The running thread waits as wait_on() does. While there are other processes of its family, until `is_ready` too:
/// what it waits for may be done by one of them.
Wait wait_on_shared(kernel::Object& object, Time deadline, bool (*is_ready)(const void*), const void* what);

/// From outside all threads, at the end of an instant: looks at what threads wait for, and waits in real time if
/// `may_wait`. Whether one of them goes on.
bool look_outside(bool may_wait);
/// Waits in real time for anything that threads wait for, but no longer than so; whether something may have come.
bool wait_outside_for(Duration longest);

}  // namespace waitpoint::posix
