// SPDX-License-Identifier: BSD-3-Clause
// The processor time of this thread, for figures that are shown: nothing of a run depends on it.
#pragma once

#include <time.h>

namespace waitpoint::run {

inline double processor_s() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace waitpoint::run
