// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/misuse.hpp"

#include "core/error.hpp"
#include "fibers/sync/object_names.hpp"

namespace waitpoint::sync {

const char* about(const kernel::Object& object, const char* message) {
  static std::string text;
  text = std::string(message) + ": " + describe(object);
  if (const std::string holders = describe_holders(object); !holders.empty()) text += ", " + holders;
  return text.c_str();
}

void check_destroyed(const kernel::Object& object) {
  if (kernel::running == nullptr) return;
  const kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (scheduler.unwinding() || !scheduler.has_entered(object)) return;
  WAITPOINT_CHECK(object.owner == nullptr && object.holder_count == 0, about(object, "destroyed while it is held"));
  WAITPOINT_CHECK(object.users == 0, about(object, "destroyed while tasks wait for it"));
}

void drain_woken_waiters(const kernel::Object& object) {
  if (kernel::running == nullptr) return;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  while (scheduler.has_entered(object) && object.users != 0 && object.first_waiter == nullptr)
    if (!scheduler.yield()) return;
}

void check_holds_nothing(const kernel::Task& task) {
  WAITPOINT_CHECK(task.held == nullptr, about(*task.held, "a thread ends while it holds a lock"));
  WAITPOINT_CHECK(task.held_shared == 0, "a thread ends while it holds a lock together with others");
}

}  // namespace waitpoint::sync
