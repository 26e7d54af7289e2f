// SPDX-License-Identifier: BSD-3-Clause
// The robot's tick counter (tickLib), its clock rate (sysLib), and its start (h2initGlob).
#pragma once

#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// Starts the robot's clock at the caller's local time; 0 means no clock. Every module of a robot may call it, with the
/// same rate: a negative or different one is EINVAL.
STATUS h2initGlob(int ticksPerSec);

/// Ticks per second; 0 without a clock.
int sysClkRateGet();

/// Ticks since the clock started, or since the last tickSet(). A waitpoint: other tasks may set it.
unsigned long tickGet();
/// Sets the count returned by tickGet(). Time-outs, watchdogs and timers are unaffected, as in VxWorks.
void tickSet(unsigned long ticks);

}  // namespace waitpoint::laas
