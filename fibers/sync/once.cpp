// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/once.hpp"

#include "fibers/kernel/waiting_calls.hpp"

namespace waitpoint {

bool once_flag::begin() {
  if (sync::enter_run(object_)) done_ = false;
  if (!sync::before_blocking(kernel::Operation::call_once, object_)) return false;
  while (!done_) {
    if (object_.owner == nullptr) {
      object_.owner = kernel::running;
      return true;
    }
    if (!sync::block(object_)) return false;
  }
  return false;
}

void once_flag::end(bool returned) {
  if (!sync::before_releasing(kernel::Operation::release, object_)) return;
  object_.owner = nullptr;
  done_ = returned;
  if (returned)
    kernel::wake_all(*kernel::running->scheduler, object_);
  else
    kernel::wake_one(*kernel::running->scheduler, object_);
}

}  // namespace waitpoint
