// SPDX-License-Identifier: BSD-3-Clause
// The threads of this process that wait for descriptors, for something outside, or for objects of several processes:
// the list that is searched for those that can continue, and what the other processes of the family need to know of it.
#pragma once

#include <poll.h>

#include "fibers/kernel/task.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix {

/// A waiting thread; on its own stack.
struct Waiter {
  kernel::Task* task;
  pollfd* descriptors;
  nfds_t count;
  bool outside;
  family::Changes awaited;
  Partner partner = Partner::none;          ///< the nearest at a descriptor outside
  bool (*is_ready)(const void*) = nullptr;  ///< null: one of the descriptors
  const void* what = nullptr;
  Waiter* next = nullptr;
  Waiter* previous = nullptr;
};

/// The first of the list; null: nobody waits.
Waiter* first_waiter();
void add(Waiter& waiter);
void remove(Waiter& waiter);
/// In the child: no thread waits.
void forget_waiters();
/// The task no longer exists.
void forget_waiter(const kernel::Task& task);
/// For what a thread waits here, for reports; null and 0 if it is no descriptor.
const pollfd* awaited_descriptors(const kernel::Task& task, nfds_t& count);

/// What a thread awaits at these descriptors.
family::Changes awaited_at(const pollfd* descriptors, nfds_t count);
/// What threads wait for outside.
family::Changes awaited_outside();
/// What an epoll descriptor watches has changed, while threads may wait for it.
void note_changed_watches();

/// One more, or one less, waits for a signal from outside, which has no place in the list.
void count_signal_waits(int by);
/// True if a thread waits for a condition that must be polled.
bool anybody_must_ask();
/// True if a thread waits for something outside.
bool anybody_waits_outside();
/// True if a thread waits for a terminal or a standard input from outside.
bool anybody_awaits_stream();
/// True if the wait of one may be ended by somebody who is not of the family. Waits at sockets whose both ends are of
/// the family are not, though the system delivers; while schedules are explored, nor are those at sockets that nobody
/// is connected to, and for signals.
bool anybody_awaits_outsiders();
/// The same for descriptors with a partner outside (partners.hpp); with a possible one only if no other thread of the
/// program could be at the other end.
bool anybody_awaits_partner(const kernel::Scheduler& scheduler);

}  // namespace waitpoint::posix
