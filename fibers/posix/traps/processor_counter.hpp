// SPDX-License-Identifier: BSD-3-Clause
// The processor's counter, which programs read by an instruction (rdtsc, rdtscp): trapped, if that was asked for, it
// counts the nanoseconds of CLOCK_MONOTONIC.
#pragma once

namespace waitpoint::posix {

/// From now on the instruction is a fault.
void trap_processor_counter();
/// In a handler of SIGSEGV: whether it was that instruction, and was done.
bool emulate_processor_counter(void* context);

}  // namespace waitpoint::posix
