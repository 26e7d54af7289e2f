// SPDX-License-Identifier: BSD-3-Clause
// Annotations of fibers for AddressSanitizer, ThreadSanitizer, LeakSanitizer and valgrind: which memory is a stack,
// which stack is in use, and, for ThreadSanitizer, the happens-before order.
//
// Their runtimes are found by weak symbols: the same kernel, itself never instrumented, serves plain and sanitized
// programs. Without any of them, these functions are not called: callers test `present` first.
//
// To ThreadSanitizer each task is a thread, and a switch does not synchronise: accesses of two tasks to memory are a
// race unless ordered by uses of an object. These happens-before edges are annotated:
//
//   maker -> new task                   by the making of the fiber
//   each use of an object -> the next   at every waitpoint, before every block, at every wake-up
//   outside -> tasks -> outside         whenever the context that runs them is entered
#pragma once

#include "fibers/switch/stack.hpp"

namespace waitpoint::kernel {

struct Fiber;

namespace sanitizer {

/// True if any of them is in this process; set by look().
extern bool present;

/// Looks for their runtimes.
void look();

/// A run begins; a run is over and its tasks are unwound.
void begin_run();
void end_run();

/// `stack` is about to be used: discards the history of its memory.
void open_stack(const Stack& stack);
/// `stack` is free again.
void close_stack(const Stack& stack);

/// `fiber` was made by the running fiber.
void prepare(Fiber& fiber);
/// Sets the name of `fiber` in reports.
void name(const Fiber& fiber, const char* name);
/// Immediately before the switch from `from` to `to`.
void leave(Fiber& from, Fiber& to);
/// Immediately after a switch: in `here`, from `left`.
void arrive(Fiber& left, Fiber& here);

/// Attributes the following accesses, up to leave_timer(), to a timer instead of the running fiber. `known_as` is the
/// sanitizer's handle of the timer (null at first). Returns the argument of leave_timer().
void* enter_timer(void*& known_as);
void leave_timer(void* interrupted);
/// Frees the handle of a timer.
void end_timer(void* known_as);

/// The caller's accesses so far happen before those of others after their acquire() of `object`.
void release(const void* object);
/// The accesses of others before their release() of `object` happen before the caller's from now on.
void acquire(const void* object);
/// acquire(), then release().
void use(const void* object);
/// The caller has read this word's value in memory: its later atomic loads return no older one.
void read(const void* word, std::size_t size);
/// The system has made all threads of the process pass a fence: no later atomic load of any misses an earlier store.
void barrier();

}  // namespace sanitizer
}  // namespace waitpoint::kernel
