// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/object.hpp"

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/post_mortem.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint::sync {

void check_destroyed(const kernel::Object& object) {
  if (kernel::running == nullptr) return;
  const kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (kernel::is_unwinding(scheduler) || !kernel::has_entered(scheduler, object)) return;
  WAITPOINT_REQUIRE(object.owner == nullptr && object.holder_count == 0, about(object, "destroyed while it is held"));
  WAITPOINT_REQUIRE(object.users == 0, about(object, "destroyed while tasks wait for it"));
}

void drain_woken_waiters(const kernel::Object& object) {
  if (kernel::running == nullptr) return;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  while (kernel::has_entered(scheduler, object) && object.users != 0 && object.first_waiter == nullptr)
    if (!kernel::yield(scheduler)) return;
}

}  // namespace waitpoint::sync

// Of every misuse (core/error.hpp). Here, since each program that uses a primitive links this source.
extern "C" void waitpoint_describe_caller() {
  using namespace waitpoint;
  // A task's stack may be too small: the handler of the abort has one of its own. With a sanitizer there is no handler,
  // and all stacks are large.
  if (kernel::running == nullptr || kernel::sanitizer::present) return sync::write_call_stack("");
  kernel::set_call_stack_writer(sync::write_call_stack);
}
