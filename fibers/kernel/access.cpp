// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/access.hpp"

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {

const char memory_kind[] = "memory";

void access(Operation operation, Object* memory) {
  if ((running->attention & attention::timer) != 0) return;
  running->scheduler->waitpoint(operation, memory);
}

std::uint32_t choose_value(std::uint32_t count) {
  if (count < 2 || (running->attention & attention::timer) != 0) return 0;
  return running->scheduler->chooser().value(*running, count);
}

void yield_after_computing() {
  Task& task = *running;
  if ((task.attention & attention::timer) != 0) return;
  if (const auto computes_long = task.scheduler->hooks().computes_long;
      computes_long != nullptr && !task.scheduler->unwinding())
    computes_long(task);
  task.scheduler->yield();
}

}  // namespace waitpoint::kernel
