// SPDX-License-Identifier: BSD-3-Clause
// What AddressSanitizer, ThreadSanitizer, LeakSanitizer and valgrind are told about fibers, where one of them is in the
// process: which memory is a stack, whose stack is in use, and, for ThreadSanitizer, what happens before what.
//
// Their runtimes are met by weak symbols: the same kernel, itself never instrumented, serves plain programs and
// sanitized ones. Without any of them, nothing here is called: callers look at `present` first.
//
// ThreadSanitizer sees each task as a thread of its own, and switches as nothing that orders them: what two tasks do to
// memory is a race unless they met at an object. These edges are told:
//
//   maker -> new task                   by the making of the fiber
//   each use of an object -> the next   at every waitpoint, before every block, at every wake-up
//   outside -> tasks -> outside         whenever the context that runs them is entered
#pragma once

#include "fibers/switch/stack.hpp"

namespace waitpoint::kernel {

struct Fiber;

namespace sanitizer {

/// Whether any of them is in this process; known once look() was called.
extern bool present;

/// Looks for them.
void look();

/// A run begins; it is over, its tasks unwound.
void begin_run();
void end_run();

/// `stack` is about to be used: nothing that was known of its memory holds any more.
void open_stack(const Stack& stack);
/// `stack` is free again.
void close_stack(const Stack& stack);

/// `fiber` was made, by the one that is running.
void prepare(Fiber& fiber);
/// What reports are to call it.
void name(const Fiber& fiber, const char* name);
/// Immediately before the switch from `from` to `to`.
void leave(Fiber& from, Fiber& to);
/// Immediately after a switch: in `here`, from `left`.
void arrive(Fiber& left, Fiber& here);

/// What follows, up to leave_timer, is not what the running fiber does: a timer's doing, of which `known_as` is the
/// sanitizer's record (null at first). Returns what leave_timer wants.
void* enter_timer(void*& known_as);
void leave_timer(void* interrupted);
/// There will be no more of it.
void end_timer(void* known_as);

/// What the caller did so far happens before what others do after they acquired `object`.
void release(const void* object);
/// What others did before they released `object` happens before what the caller does from now on.
void acquire(const void* object);
/// Both: first acquire(), then release().
void use(const void* object);

}  // namespace sanitizer
}  // namespace waitpoint::kernel
