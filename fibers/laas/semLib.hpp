// SPDX-License-Identifier: BSD-3-Clause
// VxWorks' semaphores as implemented by pocolibs. Options (SEM_Q_FIFO, SEM_Q_PRIORITY) are accepted and ignored.
//
// Calls return OK, or ERROR with the caller's error code: S_semLib_TIMEOUT, S_semLib_NOT_A_SEM (null or deleted),
// EINVAL, EPERM, EOVERFLOW. A deleted semaphore's id may be reused.
#pragma once

#include <cstddef>

#include "fibers/laas/include/semLib.h"
#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// The greatest number per robot at a time: more are S_semLib_TOO_MANY_SEM.
inline constexpr std::size_t semaphores_max = 65536;

// Enumerations of this namespace: those of pocolibs' header would make its functions candidates of each call.
enum SEM_B_STATE { SEM_EMPTY = 0, SEM_FULL = 1 };
enum { SEM_Q_FIFO, SEM_Q_PRIORITY };

class Semaphore;
using SEM_ID = Semaphore*;

/// A binary semaphore. It counts like a counting one, as pocolibs' does, so that no give is lost. Null on error.
SEM_ID semBCreate(int options, SEM_B_STATE initialState);
/// A counting semaphore; a negative count is EINVAL. Null on error.
SEM_ID semCCreate(int options, int initialCount);
/// A mutex, initially free, first come, first served. Relocking is a deadlock. Null on error.
SEM_ID semMCreate(int options);
/// Waiting tasks fail with S_semLib_NOT_A_SEM.
STATUS semDelete(SEM_ID semId);
/// Releases a unit, directly to a waiting task if there is one. A mutex must be held by the caller (EPERM).
STATUS semGive(SEM_ID semId);
/// Takes a unit: WAIT_FOREVER waits without limit, NO_WAIT only tries, and n ticks end at the n+1st tick from now
/// (S_semLib_TIMEOUT). Any other time-out is EINVAL.
STATUS semTake(SEM_ID semId, int timeout);
/// Wakes all waiting tasks, with OK but without a unit; the count is unchanged, as in VxWorks. (pocolibs' own loop
/// leaves one unit more.) A mutex cannot be flushed: EINVAL.
STATUS semFlush(SEM_ID semId);

}  // namespace waitpoint::laas
