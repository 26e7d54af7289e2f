// SPDX-License-Identifier: BSD-3-Clause
// Waiting for descriptors. The pipes, sockets and files behind them are real, so that dup, fork and exec keep working;
// simulated are the waits, their duration and order: a call that would block its thread waits here until the descriptor
// is ready, and is made then.
//
// A descriptor is inside while only this program, with the processes of its family, has its ends: it becomes ready by
// an action of one of their threads, and is checked after such actions. All others are outside: their state depends on
// real time, so they are checked only when no thread can continue at the present instant, and waited for in real time
// only when none can continue at all.
#pragma once

#include <poll.h>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/descriptors/inside_files.hpp"
#include "fibers/posix/descriptors/waiters.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// The running thread waits until any of the descriptors is ready. As poll(), returns how many are ready, with their
/// `revents`; 0 at the deadline or if the thread was cancelled; -1 with EINTR if a signal interrupted the wait. If all
/// are inside, or streams with both ends in the family, it returns at once if one is ready.
int wait_for(pollfd* descriptors, nfds_t count, Time deadline, Restart restart);
/// For one descriptor.
int wait_for(int descriptor, short events, Time deadline, Restart restart);

/// Scope in which the running thread waits for a signal from outside.
class WaitsOutside {
 public:
  WaitsOutside();
  ~WaitsOutside();
  WaitsOutside(const WaitsOutside&) = delete;
  WaitsOutside& operator=(const WaitsOutside&) = delete;
};

/// Waits in real time until `descriptor` is writable, while no thread runs; false after `patience_ms`.
bool wait_for_reader(int descriptor, int patience_ms);

/// Called, unless null, before each check of descriptors: a reader may have made room for data under way to it.
extern void (*before_look)();
/// Called, unless null, by a thread that is about to wait for a possible partner outside.
extern void (*before_partner)();
/// After an action on a descriptor: wakes the threads whose descriptors are ready.
void look_at_descriptors(family::Changes changes = family::of_descriptors);

/// The running thread waits for a condition outside that is no descriptor. 1 once `is_ready` is true; 0 if the thread
/// was cancelled; -1 with EINTR if a signal interrupted the wait.
int wait_outside(bool (*is_ready)(const void*), const void* what, Restart restart);

/// As wait_on(); it also ends when `is_ready` is true, as another process of the family may change the object.
Wait wait_on_shared(kernel::Object& object, Time deadline, bool (*is_ready)(const void*), const void* what);

/// At the end of an instant, outside all threads: checks the conditions of waiting threads, and waits in real time if
/// `may_wait`. True if a thread may continue. Only those are checked that wait for these changes.
bool look_outside(bool may_wait, family::Changes changes = family::of_anything);
/// Called when a thread may continue because of that. What has come from outside or from another process may follow
/// from anything that a thread has done: for the detection of races. Null without it.
extern void (*note_what_came)();
/// Waits in real time for anything that threads wait for, at most `longest`; true if something may have come.
bool wait_outside_for(Duration longest);

}  // namespace waitpoint::posix
