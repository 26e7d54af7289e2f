// SPDX-License-Identifier: BSD-3-Clause
// One of several runs whose events have one common order: the processes of a program (posix/family). Each run tells
// the key of its least event, has the others' as a limit in its list, and follows their time.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/event.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct EventNode;

/// The key of the least event; EventKey::never() if there is none.
EventKey next_key(Scheduler& scheduler);
/// Inserts a timer's event with a key of another run's.
void schedule(Scheduler& scheduler, EventNode& node, const EventKey& key);
/// Outside of tasks: moves the global time forward, before the next event.
void advance(Scheduler& scheduler, Time time);
/// After a fork, in the child: the running task, the only one, continues with this id. Its robot's id and digest may
/// have been replaced.
void continue_as(Scheduler& scheduler, std::uint64_t id);

}  // namespace waitpoint::kernel
