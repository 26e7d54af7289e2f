// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/semLib.hpp"
#include "fibers/laas/include/semLib.h"

namespace laas = waitpoint::laas;

namespace {

SEM_ID to_c(laas::SEM_ID semaphore) { return reinterpret_cast<SEM_ID>(semaphore); }
laas::SEM_ID from_c(SEM_ID semaphore) { return reinterpret_cast<laas::SEM_ID>(semaphore); }

}  // namespace

SEM_ID semBCreate(int options, SEM_B_STATE initialState) {
  return to_c(laas::semBCreate(options, static_cast<laas::SEM_B_STATE>(initialState)));
}

SEM_ID semCCreate(int options, int initialCount) { return to_c(laas::semCCreate(options, initialCount)); }

SEM_ID semMCreate(int options) { return to_c(laas::semMCreate(options)); }

STATUS semDelete(SEM_ID semId) { return laas::semDelete(from_c(semId)); }

STATUS semGive(SEM_ID semId) { return laas::semGive(from_c(semId)); }

STATUS semTake(SEM_ID semId, int timeout) { return laas::semTake(from_c(semId), timeout); }

STATUS semFlush(SEM_ID semId) { return laas::semFlush(from_c(semId)); }
