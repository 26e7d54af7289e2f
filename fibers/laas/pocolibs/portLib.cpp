// SPDX-License-Identifier: BSD-3-Clause
// portLib's common calls, and the robot's clock: osInit, h2initGlob, sysLib, tickLib, errnoLib and logLib.
#include "fibers/laas/portLib.hpp"

#include <bit>
#include <cstdarg>
#include <cstdio>

#include "fibers/laas/include/h2endianness.h"
#include "fibers/laas/include/h2initGlob.h"
#include "fibers/laas/include/portLib.h"
#include "fibers/laas/include/tickLib.h"
#include "fibers/laas/taskLib.hpp"
#include "fibers/laas/tickLib.hpp"

namespace laas = waitpoint::laas;

STATUS osInit(int ticksPerSec) { return laas::h2initGlob(ticksPerSec); }

void osExit() {}

STATUS h2initGlob(int ticksPerSec) { return laas::h2initGlob(ticksPerSec); }

STATUS sysClkRateSet(int ticksPerSecond) { return laas::h2initGlob(ticksPerSecond); }

int sysClkRateGet() { return laas::sysClkRateGet(); }

unsigned long tickGet() { return laas::tickGet(); }

void tickSet(unsigned long ticks) { laas::tickSet(ticks); }

int errnoGet() { return laas::errnoGet(); }

STATUS errnoSet(int errorValue) { return laas::errnoSet(errorValue); }

H2_ENDIANNESS h2localEndianness() { return std::endian::native == std::endian::big ? H2_BIG_ENDIAN : H2_LITTLE_ENDIAN; }

STATUS logInit(int, int) { return OK; }

void logEnd() {}

int logMsg(const char* fmt, ...) {
  const int head = std::fprintf(stderr, "%s: ", laas::taskName(0));
  std::va_list arguments;
  va_start(arguments, fmt);
  const int rest = std::vfprintf(stderr, fmt, arguments);
  va_end(arguments);
  return head + rest;
}
