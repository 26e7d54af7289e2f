// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/barrier.hpp"

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::sync {

void BarrierCore::refresh() {
  if (!enter_run(object_)) return;
  expected_ = missing_ = initial_;
  phase_ = 0;
}

BarrierCore::Arrival BarrierCore::arrive(std::ptrdiff_t count, std::ptrdiff_t dropped) {
  refresh();
  if (!before_releasing(kernel::Operation::arrive, object_)) return {phase_, false};
  WAITPOINT_REQUIRE(count > 0 && count <= missing_, about(object_, "more arrivals at a barrier than it expects"));
  expected_ -= dropped;
  missing_ -= count;
  return {phase_, missing_ == 0};
}

void BarrierCore::end_phase() {
  // The run may have ended in the completion function.
  if (kernel::is_unwinding(*kernel::running->scheduler)) return;
  missing_ = expected_;
  ++phase_;
  // The completion function ran after the last arrival's waitpoint.
  kernel::sanitizer::release(&object_);
  kernel::note_transfer();
  kernel::wake_all(*kernel::running->scheduler, object_);
}

bool BarrierCore::wait_before(std::uint64_t phase, Time deadline) {
  refresh();
  const auto operation = deadline <= running_task().local_time ? kernel::Operation::try_wait : kernel::Operation::wait;
  if (!before_blocking(operation, object_)) return true;
  WAITPOINT_REQUIRE(phase == phase_ || phase + 1 == phase_,
                    about(object_, "a task waits for an outdated phase of a barrier"));
  if (phase != phase_) return true;
  if (deadline <= kernel::running->local_time) return false;
  return block(object_, deadline);
}

}  // namespace waitpoint::sync
