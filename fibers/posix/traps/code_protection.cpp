// SPDX-License-Identifier: BSD-3-Clause
//
// A program that makes its code writable is about to change it.
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/traps/access_breakpoints.hpp"

namespace waitpoint::posix {

WAITPOINT_INTERPOSED int mprotect(void* begin, std::size_t bytes, int protection) noexcept {
  if ((protection & PROT_WRITE) != 0) prevent_breakpoints_in(begin, bytes);
  return static_cast<int>(WAITPOINT_NEXT(syscall)(SYS_mprotect, begin, bytes, protection));
}

}  // namespace waitpoint::posix
