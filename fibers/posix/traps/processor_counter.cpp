// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/processor_counter.hpp"

#include <sys/prctl.h>
#include <ucontext.h>

#include <cstdint>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

bool is_counter_trapped = false;

// The length of the instruction; 0 if it is not one of them.
int length_of_reading(const unsigned char* code) {
  if (code[0] != 0x0F) return 0;
  if (code[1] == 0x31) return 2;                      // rdtsc
  return code[1] == 0x01 && code[2] == 0xF9 ? 3 : 0;  // rdtscp
}

}  // namespace

void trap_processor_counter() {
  is_counter_trapped = true;
  install(SIGSEGV);
  prctl(PR_SET_TSC, PR_TSC_SIGSEGV, 0, 0, 0);
}

CounterReleased::CounterReleased() {
  if (is_counter_trapped) prctl(PR_SET_TSC, PR_TSC_ENABLE, 0, 0, 0);
}
CounterReleased::~CounterReleased() {
  const ErrorNumberKept kept;
  if (is_counter_trapped) prctl(PR_SET_TSC, PR_TSC_SIGSEGV, 0, 0, 0);
}

bool emulate_processor_counter(void* context) {
  if (!is_counter_trapped) return false;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const int length = length_of_reading(reinterpret_cast<const unsigned char*>(registers[REG_RIP]));
  if (length == 0) return false;
  Time now;
  if (is_simulated()) {
    spend(record->settings.call_cost);
    now = kernel::local_time(*kernel::running);
  }
  const auto count = static_cast<std::uint64_t>(reading_ns(CLOCK_MONOTONIC, now));
  registers[REG_RAX] = static_cast<greg_t>(count & 0xFFFFFFFF);
  registers[REG_RDX] = static_cast<greg_t>(count >> 32);
  if (length == 3) registers[REG_RCX] = 0;  // the processor's number
  registers[REG_RIP] += length;
  return true;
}

}  // namespace waitpoint::posix
