// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/h2timerLib.hpp"
#include "fibers/laas/include/h2timerLib.h"

namespace laas = waitpoint::laas;

namespace {

laas::H2TIMER_ID from_c(H2TIMER_ID timer) { return reinterpret_cast<laas::H2TIMER_ID>(timer); }

}  // namespace

STATUS h2timerInit() { return OK; }

STATUS h2timerEnd() { return OK; }

H2TIMER_ID h2timerAlloc() { return reinterpret_cast<H2TIMER_ID>(laas::h2timerAlloc()); }

STATUS h2timerStart(H2TIMER_ID timerId, int periode, int delay) {
  return laas::h2timerStart(from_c(timerId), periode, delay);
}

STATUS h2timerPause(H2TIMER_ID timerId) { return laas::h2timerPause(from_c(timerId)); }

STATUS h2timerPauseReset(H2TIMER_ID timerId) { return laas::h2timerPauseReset(from_c(timerId)); }

STATUS h2timerStop(H2TIMER_ID timerId) { return laas::h2timerStop(from_c(timerId)); }

STATUS h2timerChangePeriod(H2TIMER_ID timerId, int periode) {
  return laas::h2timerChangePeriod(from_c(timerId), periode);
}

STATUS h2timerFree(H2TIMER_ID timerId) { return laas::h2timerFree(from_c(timerId)); }
