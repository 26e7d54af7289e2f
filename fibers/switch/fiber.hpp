// SPDX-License-Identifier: BSD-3-Clause
// A stack that can be left and re-entered. Only fiber.cpp uses Boost.Context: to make fibers, and to switch them on
// other processors than x86-64 (departure.hpp).
//
// Boost 1.74 keeps no exception state per fiber: a fiber that switches inside a catch block, or in a destructor during
// unwinding, would see another's exceptions. So the runtime's per-thread record of exceptions in flight, and errno, are
// saved and restored at every switch.
#pragma once

#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

/// Binds the fibers to the calling thread; to be called before it leaves its own stack for the first time.
void bind_to_thread();

/// Makes `fiber` ready to run `entry(argument)` on `stack` below `top`. `entry` must not return.
void prepare(Fiber& fiber, const Stack& stack, char* top, void (*entry)(void*), void* argument);

/// Leaves `from` and continues in `to`; returns when `from` is switched to again.
void switch_fiber(Fiber& from, Fiber& to);

}  // namespace waitpoint::kernel
