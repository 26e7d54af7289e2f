// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/watch.hpp"

#include "fibers/kernel/access.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

void set_watch(Scheduler& scheduler, Watch* watch) {
  turn.close();  // the fast path does not show events
  scheduler.watching = {watch, watch != nullptr || sanitizer::present || debugger_view.watching};
}

Watch* watch(const Scheduler& scheduler) { return scheduler.watching.watch; }

void show(const Scheduler& scheduler, Operation operation, const Object* object) {
  // Uses of an object synchronise, in their order; accesses to memory do not.
  if (object != nullptr && object->kind != memory_kind && sanitizer::present) sanitizer::use(object);
  const Time now = scheduler.agenda.now;
  if (Watch* const watch = scheduler.watching.watch; watch != nullptr)
    watch->event(*watch, {now, running, operation, object});
  if (debugger_view.watching) show_debugger(now, *running, operation, object);
}

}  // namespace waitpoint::kernel
