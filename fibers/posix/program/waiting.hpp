// SPDX-License-Identifier: BSD-3-Clause
// Waitpoints of a program's threads.
//
// A program declares no computing times, so its threads are at one instant until one sleeps. But polling loops must
// end, in a number of rounds that is a real machine's: reading a clock, yielding and using a primitive take a little
// virtual time. Uses of primitives are charged together, which keeps them fast; in an exploration more of them, and
// some dozen readings, so that threads stay at one instant with the others.
#pragma once

#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/posix/program/processor_timers.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// Uses of primitives that are charged together. While schedules are explored, several such batches are.
inline constexpr std::uint32_t operations_at_once = 128;
static_assert(operations_at_once < Thread::in_kernel, "a thread in the kernel never passes at once");
/// After as many, other tasks due at this instant get a turn.
inline constexpr std::uint32_t clock_readings_at_most = 100;
inline constexpr Duration cost_of_giving_way = Duration(std::chrono::microseconds(1));
/// Of 100 000 accesses to memory, as long as they take: after as many without a call, instrumented code yields.
inline constexpr Duration cost_of_accesses = Duration(std::chrono::milliseconds(1));
/// The same for basic blocks.
inline constexpr Duration cost_of_blocks = Duration(std::chrono::microseconds(200));

/// The running thread computes for `cost`.
inline void spend(Duration cost) {
  WAITPOINT_FAST_CHECK(cost >= Duration(), "a thread computes for less than no time");
  kernel::Task& task = *kernel::running;
  Thread& thread = thread_of(task);
  thread.spent += cost;
  thread.program->spent += cost;
  kernel::compute(task, cost);
  if (__builtin_expect(first_processor_timer != nullptr, 0)) look_at_processor_timers();
}

/// The same for the operations of polling loops, charged singly or `looks_at_once` together.
inline void spend_for_look(Duration cost) {
  Thread& thread = this_thread();
  const std::uint32_t looks = record->settings.looks_at_once;
  WAITPOINT_FAST_CHECK(looks > 0 && thread.looks < looks, "uses of clocks were not charged when due");
  if (++thread.looks < looks) return;
  thread.looks = 0;
  spend(cost * looks);
}

/// The same for a batch of uses of primitives, or for as many batches as the run charges together.
inline void spend_for_operations(Thread& thread) {
  thread.operations = 0;
  const std::uint32_t batches = record->settings.batches_at_once;
  WAITPOINT_FAST_CHECK(batches > 0 && thread.batches < batches, "uses of primitives were not charged when due");
  if (++thread.batches < batches) return;
  thread.batches = 0;
  spend(record->settings.call_cost * operations_at_once * batches);
}

/// The running thread, whose accesses to memory are seen, has made many of them without a call: it may wait for another
/// thread, or for the handler of a timer's signal. So virtual time passes. While schedules are explored none does until
/// all others wait; then it goes on to the next event.
void spend_for_computing(kernel::Task& task);

/// The running thread's waitpoint: returns when its event is the least.
inline void pass(kernel::Operation operation, kernel::Object* object) {
  kernel::Task& task = *kernel::running;
  Thread& thread = thread_of(task);
  if (++thread.operations >= operations_at_once) spend_for_operations(thread);
  const InKernel within;
  kernel::waitpoint(*task.scheduler, operation, object);
}

/// The same for the running `task` if no other event can come first: then only a count is needed. Else false, with no
/// effect.
[[gnu::always_inline]] inline bool pass_at_once(kernel::Task* task, kernel::Operation operation,
                                                kernel::Object& object) {
  if (task == nullptr || !is_thread(*task)) return false;
  Thread& thread = thread_of(*task);
  const std::uint32_t operations = thread.operations + 1;
  if (operations >= operations_at_once) return false;  // also if in the kernel
  if (!kernel::try_fast_waitpoint(operation, object)) return false;
  thread.operations = operations;
  return true;
}

/// Blocks the running thread on `object`; false at the deadline. Signals stay pending until it continues.
inline bool block(kernel::Object& object, Time deadline) {
  const InKernel within;
  return kernel::block(*kernel::running->scheduler, object, deadline) == kernel::Wake::woken;
}

/// Wakes a waiter selected by the chooser; null without one.
inline kernel::Task* wake_one(kernel::Object& object) { return kernel::wake_one(*kernel::running->scheduler, object); }

}  // namespace waitpoint::posix
