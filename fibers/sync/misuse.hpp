// SPDX-License-Identifier: BSD-3-Clause
// Misuse of a primitive is reported with the operation, the object and its holders.
//
//   WAITPOINT_REQUIRE(owner == running, sync::about(object, "a task unlocks a mutex that it does not hold"));
#pragma once

#include "fibers/kernel/scheduler.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint::sync {

/// `message` with the object's name and holders, for a failed check; the text is a static buffer.
const char* about(const kernel::Object& object, const char* message);

/// For the destructors of objects that may be destroyed once no task waits: gives woken tasks that have not run since a
/// turn to leave.
void drain_woken_waiters(const kernel::Object& object);

/// Called at the end of a thread: holding a lock then is a misuse.
void check_holds_nothing(const kernel::Task& task);

}  // namespace waitpoint::sync
