// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/blocking.hpp"

namespace waitpoint::sync {

bool waitpoint_unseen(kernel::Operation operation, kernel::Object& object) {
  return running_task().scheduler->waitpoint(operation, &object);
}

kernel::Task* wake_one_unseen(kernel::Object& object) { return running_task().scheduler->wake_one(object); }

bool block_unseen(kernel::Object& object, Time deadline) { return block_here(object, deadline); }

}  // namespace waitpoint::sync
