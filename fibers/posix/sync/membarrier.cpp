// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/membarrier.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {

// All threads run in one of the system's: only what instrumented code reads depends on it.
long membarrier(int command, unsigned flags, int processor) {
  const long result = WAITPOINT_NEXT(syscall)(SYS_membarrier, command, flags, processor);
  if (result >= 0) kernel::sanitizer::barrier();
  return result;
}

}  // namespace waitpoint::posix
