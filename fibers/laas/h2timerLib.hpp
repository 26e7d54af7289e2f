// SPDX-License-Identifier: BSD-3-Clause
// comLib's timers: a table of 20 per robot, by which its periodic tasks distribute themselves over time.
//
// A timer first fires at the next tick whose number modulo 20 is its delay, then every period; so timers started with
// the same delay fire together, independent of their start. pocolibs recommends that the period be a multiple or a
// divisor of 20 but does not check it; nor does this.
//
// Waiting tasks are woken by the tick; firings without a waiter are counted and cost no event. Starting a timer clears
// its count, so that its phase holds from the first h2timerPause on (pocolibs may have left-overs there).
//
// STATUS calls return ERROR with an error code of the list below.
#pragma once

#include "fibers/laas/include/h2timerLib.h"
#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

struct H2TIMER;
using H2TIMER_ID = H2TIMER*;

/// A stopped timer; null without a clock (TIMER_NOT_INIT) or if all are in use (TOO_MUCH_TIMERS).
H2TIMER_ID h2timerAlloc();
/// Starts a stopped timer, in ticks: a period of at least 1, a delay from 0 to 19.
STATUS h2timerStart(H2TIMER_ID timerId, int period, int delay);
/// Waits for the timer to fire; returns at once if it has since the last return: missed firings count as one. On a
/// stopped timer without a missed firing, it waits until the timer is started again and fires.
STATUS h2timerPause(H2TIMER_ID timerId);
/// As h2timerPause, but consumes one missed firing, and begins a new period from there.
STATUS h2timerPauseReset(H2TIMER_ID timerId);
/// Missed firings remain.
STATUS h2timerStop(H2TIMER_ID timerId);
/// For a timer that is not stopped; the elapsed part of the old period counts, modulo the new one.
STATUS h2timerChangePeriod(H2TIMER_ID timerId, int period);
/// Frees the timer; waiting tasks fail with TIMER_NOT_INIT.
STATUS h2timerFree(H2TIMER_ID timerId);

}  // namespace waitpoint::laas
