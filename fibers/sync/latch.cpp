// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/latch.hpp"

#include "fibers/kernel/waiting_calls.hpp"

namespace waitpoint {

void latch::refresh() {
  if (sync::enter_run(object_)) count_ = expected_;
}

void latch::count_down(std::ptrdiff_t by) {
  refresh();
  if (!sync::before_releasing(kernel::Operation::count_down, object_)) return;
  WAITPOINT_REQUIRE(by >= 0, sync::about(object_, "a latch is counted down by a negative number"));
  WAITPOINT_REQUIRE(by <= count_, sync::about(object_, "a latch is counted down below zero"));
  count_ -= by;
  if (count_ == 0) kernel::wake_all(*kernel::running->scheduler, object_);
}

bool latch::try_wait() {
  refresh();
  return !sync::before_blocking(kernel::Operation::try_wait, object_) || count_ == 0;
}

bool latch::wait_before(Time deadline) {
  refresh();
  if (!sync::before_blocking(kernel::Operation::wait, object_) || count_ == 0) return true;
  if (deadline <= kernel::running->local_time) return false;
  return sync::block(object_, deadline);
}

}  // namespace waitpoint
