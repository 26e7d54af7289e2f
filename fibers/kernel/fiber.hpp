// SPDX-License-Identifier: BSD-3-Clause
// A stack that can be left and re-entered: the one user of Boost.Context, which makes it, and on other processors than
// x86-64 switches too (departure.hpp).
//
// Boost 1.74 keeps no exception state per fiber: one that switches inside a catch block, or in a destructor during
// unwinding, would see another's exceptions. So the runtime's per-thread record of exceptions in flight, and errno, are
// saved and restored at every switch.
#pragma once

#include <cstdint>

#include "fibers/kernel/stack_arena.hpp"

namespace waitpoint::kernel {

/// What the C++ runtime and the C library keep per thread, of which every fiber needs its own.
struct ThreadState {
  void* caught_exceptions = nullptr;
  unsigned int uncaught_exceptions = 0;
  int error_number = 0;
};

struct Fiber {
  void* context = nullptr;  ///< where it goes on; null while it runs. A debugger reads it.
  ThreadState thread_state;
  Stack stack;
  /// Where it finds its thread-local variables, its thread's state among them; null: where the thread that runs the
  /// fibers does.
  void* thread_pointer = nullptr;
  bool ended = false;        ///< it is left for good
  void* known_as = nullptr;  ///< to a sanitizer
};

/// Fibers run in the calling thread from now on: to be told before it leaves its own stack for the first time.
void bind_to_thread();

/// Makes `fiber` ready to run `entry(argument)` on `stack` below `top`. `entry` must not return.
void prepare(Fiber& fiber, const Stack& stack, char* top, void (*entry)(void*), void* argument);

/// Leaves `from` and goes on in `to`; returns when something switches back to `from`.
void switch_fiber(Fiber& from, Fiber& to);

}  // namespace waitpoint::kernel
