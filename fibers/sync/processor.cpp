// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/processor.hpp"

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {

processor::~processor() {
  if (kernel::running == nullptr || kernel::is_unwinding(*kernel::running->scheduler)) return;
  WAITPOINT_REQUIRE(!kernel::is_shared(core_), sync::about(core_.object, "destroyed while threads share it"));
}

}  // namespace waitpoint
