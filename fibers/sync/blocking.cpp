// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/blocking.hpp"

namespace waitpoint::sync {

bool waitpoint_unseen(kernel::Operation operation, kernel::Object& object) {
  return running_task().scheduler->waitpoint(operation, &object);
}

}  // namespace waitpoint::sync
