// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/recursive_mutex.hpp"

namespace waitpoint {

bool recursive_mutex::lock_before(Time deadline) {
  const auto operation = deadline <= now() ? kernel::Operation::try_lock : kernel::Operation::lock;
  if (!sync::before_blocking(operation, core_.object())) return true;
  if (core_.is_owned_by_caller()) {
    ++depth_;
    return true;
  }
  if (!core_.acquire(deadline)) return false;
  depth_ = 1;
  return true;
}

void recursive_mutex::unlock() {
  if (!sync::before_releasing(kernel::Operation::unlock, core_.object())) return;
  if (core_.is_owned_by_caller() && --depth_ > 0) return;
  core_.release();
}

}  // namespace waitpoint
