// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/mutex.hpp"

namespace waitpoint {

bool mutex::lock_before(Time deadline) {
  const auto operation = deadline <= now() ? kernel::Operation::try_lock : kernel::Operation::lock;
  if (!sync::before_blocking(operation, core_.object())) return true;
  WAITPOINT_REQUIRE(!core_.is_owned_by_caller(),
                    sync::about(core_.object(), "a task tries to lock a mutex that it holds"));
  return core_.acquire(deadline);
}

}  // namespace waitpoint
