// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/wdLib.hpp"
#include "fibers/laas/include/wdLib.h"

namespace laas = waitpoint::laas;

namespace {

laas::WDOG_ID from_c(WDOG_ID watchdog) { return reinterpret_cast<laas::WDOG_ID>(watchdog); }

}  // namespace

STATUS wdLibInit() { return OK; }

WDOG_ID wdCreate() { return reinterpret_cast<WDOG_ID>(laas::wdCreate()); }

STATUS wdDelete(WDOG_ID wdId) { return laas::wdDelete(from_c(wdId)); }

STATUS wdStart(WDOG_ID wdId, int delay, WDROUTINEFUNC pRoutine, long parameter) {
  return laas::wdStart(from_c(wdId), delay, pRoutine, parameter);
}

STATUS wdCancel(WDOG_ID wdId) { return laas::wdCancel(from_c(wdId)); }
