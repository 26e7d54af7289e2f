// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/mutex_core.hpp"

namespace waitpoint::sync {

bool MutexCore::acquire_unseen(Time deadline) { return acquire_here(deadline); }

void MutexCore::release_slow() {
  WAITPOINT_REQUIRE(is_owned_by_caller(), about(object_, "a task unlocks a mutex that it does not hold"));
  release_here();
}

}  // namespace waitpoint::sync
