// SPDX-License-Identifier: BSD-3-Clause
// The robot's tick counter (tickLib), the rate of its clock (sysLib), and how it is started (h2initGlob).
#pragma once

#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// Starts the robot's clock at the caller's local time; 0 is no clock. Every module of a robot may call it, with the
/// same rate: one that is negative or differs is EINVAL.
STATUS h2initGlob(int ticksPerSec);

/// Ticks per second; 0 without a clock.
int sysClkRateGet();

/// Ticks since the clock started, or since the count that tickSet() set. A waitpoint: others may set it.
unsigned long tickGet();
/// What tickGet() returns now. Time-outs, watchdogs and timers do not notice, as in VxWorks.
void tickSet(unsigned long ticks);

}  // namespace waitpoint::laas
