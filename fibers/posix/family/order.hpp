// SPDX-License-Identifier: BSD-3-Clause
// The common order of the events of a family's processes: by time, then by the events' keys, as if one scheduler had
// them all.
//
// Each process has its own event list. One of them runs; the others have left the keys of their least events in the
// family's memory. The window of the run ends where another's key is less than its own next: a timer's event with that
// key is in its list.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"
#include "fibers/posix/family/keys.hpp"

namespace waitpoint::posix::family {

/// The place in the table.
std::uint32_t index_of(const Process& process);
/// The key of its least event while it does not run; a ring is one.
kernel::EventKey key_of(const Process& process);
/// True if the event of `a` goes before that of `b`.
bool precedes(const Process& a, const Process& b);
/// The process with the least event among the others; null without others.
Process* least_other();
/// The key of that event.
kernel::EventKey least_of_others();
/// True if another process of the family takes turns.
bool has_others();

/// Before a window of the run, and after other processes were given events.
void limit_window(kernel::Scheduler& scheduler);
void remove_limit(kernel::Scheduler& scheduler);

/// Makes a process check, at the present instant of this one, for what its threads wait among these.
void ring(Process& process, Changes changes = of_anything);
/// The same for all whose threads wait for one of these changes.
void ring(Changes changes);

}  // namespace waitpoint::posix::family
