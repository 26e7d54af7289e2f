// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/misuse.hpp"

#include "core/error.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/object_names.hpp"
#include "fibers/sync/post_mortem.hpp"

namespace waitpoint::sync {

const char* about(const kernel::Object& object, const char* message) {
  static thread_local std::string text;
  text = std::string(message) + ": " + describe(object);
  if (const std::string holders = describe_holders(object); !holders.empty()) text += ", " + holders;
  return text.c_str();
}

void check_destroyed(const kernel::Object& object) {
  if (kernel::running == nullptr) return;
  const kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (scheduler.unwinding() || !scheduler.has_entered(object)) return;
  WAITPOINT_REQUIRE(object.owner == nullptr && object.holder_count == 0, about(object, "destroyed while it is held"));
  WAITPOINT_REQUIRE(object.users == 0, about(object, "destroyed while tasks wait for it"));
}

void drain_woken_waiters(const kernel::Object& object) {
  if (kernel::running == nullptr) return;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  while (scheduler.has_entered(object) && object.users != 0 && object.first_waiter == nullptr)
    if (!scheduler.yield()) return;
}

void check_holds_nothing(const kernel::Task& task) {
  WAITPOINT_REQUIRE(task.held == nullptr, about(*task.held, "a thread ends while it holds a lock"));
  WAITPOINT_REQUIRE(task.held_shared == 0, "a thread ends while it holds a lock together with others");
}

}  // namespace waitpoint::sync

extern "C" void waitpoint_describe_caller() {
  using namespace waitpoint;
  // A task's stack may be too small: the handler of the abort has one of its own. With a sanitizer there is no handler,
  // and all stacks are large.
  if (kernel::running == nullptr || kernel::sanitizer::present) return sync::write_call_stack("");
  kernel::set_call_stack_writer(sync::write_call_stack);
}
