// SPDX-License-Identifier: BSD-3-Clause
// Descriptors of the layer's own in a program's process. Programs expect theirs to begin at 3, and rarely reach these.
#pragma once

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {

/// Moves a descriptor, unless it is negative, to such a number; -1 with the error.
inline int move_up(int descriptor) {
  constexpr int least = 200;
  if (descriptor < 0) return -1;
  const long moved = WAITPOINT_NEXT(syscall)(SYS_fcntl, descriptor, F_DUPFD_CLOEXEC, least);
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(syscall)(SYS_close, descriptor);
  return static_cast<int>(moved);
}

}  // namespace waitpoint::posix
