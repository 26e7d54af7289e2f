// SPDX-License-Identifier: BSD-3-Clause
// Accesses to memory as switch points: the door for a runtime that sees them (fibers/explore/races).
//
// To the kernel the memory is an object like others, of a kind of its own: its number is that of its first use in the
// run, so that no address reaches an event. Unlike others it orders nothing of what its users do.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// Object::kind of memory, by address.
extern const char memory_kind[];

/// The running task is about to do `operation` to memory of which others may tell the moment: a waitpoint. `memory` is
/// null for what is of no memory. Returns at once for a timer, which cannot wait, and when the run is over.
void access(Operation operation, Object* memory);
/// The running task has computed for long without any: others get a turn. For a timer and when the run is over, as
/// above.
void give_turn();

}  // namespace waitpoint::kernel
