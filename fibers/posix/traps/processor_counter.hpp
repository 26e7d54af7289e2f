// SPDX-License-Identifier: BSD-3-Clause
// The processor's counter, which programs read by an instruction (rdtsc, rdtscp): on request (--trap-rdtsc) it is
// trapped, and counts the nanoseconds of CLOCK_MONOTONIC.
#pragma once

namespace waitpoint::posix {

/// From now on the instruction is a fault.
void trap_processor_counter();
/// While it lives, the instruction is executed: a program that is started then begins so.
class CounterReleased {
 public:
  CounterReleased();
  ~CounterReleased();
  CounterReleased(const CounterReleased&) = delete;
  CounterReleased& operator=(const CounterReleased&) = delete;
};
/// In a handler of SIGSEGV: true if it was that instruction, which is done then.
bool emulate_processor_counter(void* context);

}  // namespace waitpoint::posix
