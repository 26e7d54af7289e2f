// SPDX-License-Identifier: BSD-3-Clause
//
// Called from each basic block of code compiled with -fsanitize-coverage=trace-pc or trace-pc-guard: the blocks are
// counted for the clock `counted`. A thread that passes many without a call yields: it may wait in a loop for what
// another thread or a signal's handler sets.
#include <cstdint>

#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint64_t blocks_between_looks = 100'000;
std::uint64_t next_look = blocks_between_looks;
std::uint64_t looked_at_task = 0, looked_at_event = 0;

bool is_counted() { return record->settings.has_clock && record->settings.clock.kind == kernel::ClockKind::counted; }

[[gnu::noinline]] void look_whether_it_spins() {
  next_look = kernel::turn.blocks + blocks_between_looks;
  if (!is_simulated()) return;
  const kernel::Task& task = *kernel::running;
  const bool spins = looked_at_task == task.id && looked_at_event == task.sequence;
  if (spins) {
    if (!is_counted()) spend(cost_of_blocks);
    const InKernel within;
    kernel::yield(*task.scheduler);
  }
  looked_at_task = task.id;
  looked_at_event = task.sequence;
}

void count_block() {
  if (++kernel::turn.blocks >= next_look) look_whether_it_spins();
}

}  // namespace
}  // namespace waitpoint::posix

WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc() { waitpoint::posix::count_block(); }
WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc_guard(std::uint32_t*) { waitpoint::posix::count_block(); }
WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc_guard_init(std::uint32_t*, std::uint32_t*) {}
