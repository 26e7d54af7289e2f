// SPDX-License-Identifier: BSD-3-Clause
// VxWorks' semaphores as pocolibs has them. Options (SEM_Q_FIFO, SEM_Q_PRIORITY) are accepted and ignored.
//
// Calls return OK, or ERROR with the caller's error code: S_semLib_TIMEOUT, S_semLib_NOT_A_SEM (what is null or
// deleted), EINVAL, EPERM, EOVERFLOW. A deleted semaphore's id may come back from a later create.
#pragma once

#include <cstddef>

#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

inline constexpr int S_semLib_TOO_MANY_SEM = H2_ENCODE_ERR(22, 1);
inline constexpr int S_semLib_NOT_A_SEM = H2_ENCODE_ERR(22, 3);
inline constexpr int S_semLib_TIMEOUT = H2_ENCODE_ERR(22, 4);

/// How many semaphores a robot may have at a time: more are S_semLib_TOO_MANY_SEM.
inline constexpr std::size_t semaphores_max = 65536;

enum SEM_B_STATE { SEM_EMPTY = 0, SEM_FULL = 1 };
enum { SEM_Q_FIFO, SEM_Q_PRIORITY };

class Semaphore;
using SEM_ID = Semaphore*;

/// A binary semaphore: counts like the other, as pocolibs' does, so that no give is lost. Null on error.
SEM_ID semBCreate(int options, SEM_B_STATE initialState);
/// A counting semaphore; a negative count is EINVAL. Null on error.
SEM_ID semCCreate(int options, int initialCount);
/// A mutex, free: first come, first served. Taking it twice is a deadlock. Null on error.
SEM_ID semMCreate(int options);
/// Who waits goes on with S_semLib_NOT_A_SEM.
STATUS semDelete(SEM_ID semId);
/// Gives a unit, to one that waits if there is one. A mutex must be the caller's (EPERM).
STATUS semGive(SEM_ID semId);
/// Takes a unit: WAIT_FOREVER waits for ever, NO_WAIT only tries, and n ticks end at the n+1st tick from now
/// (S_semLib_TIMEOUT). Any other time-out is EINVAL.
STATUS semTake(SEM_ID semId, int timeout);
/// Lets all go on that wait, with OK and without a unit; the count stays what it is, as in VxWorks. (pocolibs' own loop
/// leaves one unit more.) A mutex cannot be flushed: EINVAL.
STATUS semFlush(SEM_ID semId);

}  // namespace waitpoint::laas
