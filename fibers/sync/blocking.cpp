// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/blocking.hpp"

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"

namespace waitpoint::sync {

bool waitpoint_unseen(kernel::Operation operation, kernel::Object& object) {
  return kernel::waitpoint(*running_task().scheduler, operation, &object);
}

kernel::Task* wake_one_unseen(kernel::Object& object) { return kernel::wake_one(*running_task().scheduler, object); }

bool block_unseen(kernel::Object& object, Time deadline) { return block_here(object, deadline); }

}  // namespace waitpoint::sync
