// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/access.hpp"

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"

namespace waitpoint::kernel {

const char memory_kind[] = "memory";

void access(Operation operation, Object* memory) {
  if ((running->attention & attention::timer) != 0) return;
  waitpoint(*running->scheduler, operation, memory);
}

std::uint32_t choose_value(std::uint32_t count) {
  if (count < 2 || (running->attention & attention::timer) != 0) return 0;
  return chooser(*running->scheduler).value(*running, count);
}

void yield_after_computing() {
  Task& task = *running;
  if ((task.attention & attention::timer) != 0) return;
  Scheduler& scheduler = *task.scheduler;
  if (const auto computes_long = hooks(scheduler).computes_long; computes_long != nullptr && !is_unwinding(scheduler))
    computes_long(task);
  yield(scheduler);
}

}  // namespace waitpoint::kernel
