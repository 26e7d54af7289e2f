// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/tickLib.hpp"

#include "fibers/laas/ticks.hpp"

namespace waitpoint::laas {

STATUS h2initGlob(int ticksPerSec) {
  Ticks& ticks = Ticks::here();
  if (!sync::before_releasing(kernel::Operation::timer_start, ticks.object())) return ERROR;
  return ticks.start(ticksPerSec);
}

int sysClkRateGet() { return Ticks::here().rate(); }

unsigned long tickGet() {
  Ticks& ticks = Ticks::here();
  if (!sync::before_blocking(kernel::Operation::timer_tick, ticks.object())) return 0;
  return (ticks.running() ? static_cast<std::uint64_t>(ticks.now()) : 0) + ticks.offset;
}

void tickSet(unsigned long count) {
  Ticks& ticks = Ticks::here();
  if (!sync::before_releasing(kernel::Operation::timer_tick, ticks.object())) return;
  ticks.offset = count - (ticks.running() ? static_cast<std::uint64_t>(ticks.now()) : 0);
}

}  // namespace waitpoint::laas
