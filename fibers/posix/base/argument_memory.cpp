// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/base/argument_memory.hpp"

#include <signal.h>
#include <sys/random.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

constexpr int no_change = 1000;  // an operation on the mask that the kernel does not know
constexpr long mask_size = 8;
static_assert(mask_size == (_NSIG - 1) / 8, "the kernel's set of signals has a bit for each");

}  // namespace

// The kernel reads the new mask before it rejects the operation.
bool can_be_read(const void* address) {
  const ErrorNumberKept kept;
  if (address == nullptr) return false;
  return WAITPOINT_NEXT(syscall)(SYS_rt_sigprocmask, no_change, address, nullptr, mask_size) == 0 || errno != EFAULT;
}

bool can_be_written(void* address) {
  const ErrorNumberKept kept;
  if (address == nullptr) return false;
  return WAITPOINT_NEXT(syscall)(SYS_rt_sigprocmask, SIG_BLOCK, nullptr, address, mask_size) == 0;
}

bool can_be_written(void* address, std::size_t size) {
  WAITPOINT_CHECK(size > 0, "an address is to be checked for no bytes");
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(syscall)(SYS_getrandom, address, size, GRND_INSECURE) == static_cast<long>(size);
}

}  // namespace waitpoint::posix
