// SPDX-License-Identifier: BSD-3-Clause
// Misuse of a primitive is a bug with a name: what was done, to which object, and who holds it.
//
//   WAITPOINT_CHECK(owner == running, sync::about(object, "a task unlocks a mutex that it does not hold"));
#pragma once

#include "fibers/kernel/scheduler.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint::sync {

/// `message` and the object's name and holders, for a check that failed: the text is the only one there is.
const char* about(const kernel::Object& object, const char* message);

/// For destructors of what may be destroyed as soon as nobody waits any more: those who were woken, but have not had
/// their turn since, get it.
void let_notified_leave(const kernel::Object& object);

/// For the end of a thread: it is a bug to hold something then.
void check_holds_nothing(const kernel::Task& task);

}  // namespace waitpoint::sync
