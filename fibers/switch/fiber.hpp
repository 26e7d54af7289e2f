// SPDX-License-Identifier: BSD-3-Clause
// A stack that can be left and re-entered. Only fiber.cpp uses Boost.Context: to make fibers, and to switch them
// where that is not inline (departure.hpp).
//
// Boost 1.74 keeps no exception state per fiber: a fiber that switches inside a catch block, or in a destructor during
// unwinding, would see another's exceptions. So the runtime's per-thread record of exceptions in flight, and errno, are
// saved and restored at every switch.
#pragma once

#include "fibers/switch/fiber_record.hpp"
#include "fibers/switch/thread_pointer.hpp"

namespace waitpoint::kernel {

/// Binds the fibers that the calling thread enters from now on to it; to be called before it leaves its own stack.
/// Code may keep addresses of thread-local variables in its frames: a fiber stays on the thread that entered it first.
void bind_to_thread();

/// The base of the thread-local storage that `fiber` uses: its own, or the thread's.
void* storage_of(const Fiber& fiber);

/// Makes `fiber` ready to run `entry(argument)` on `stack` below `top`. `entry` must not return.
void prepare(Fiber& fiber, const Stack& stack, char* top, void (*entry)(void*), void* argument);

/// Leaves `from` and continues in `to`, which has the same thread-local storage; returns when `from` is switched to
/// again.
void switch_fiber(Fiber& from, Fiber& to);
/// The same if `to` has another thread-local storage. The callers' own thread-local variables must be in it already:
/// see instance_for().
void switch_fiber_and_storage(Fiber& from, Fiber& to);

/// The instance that `fiber` will see of the caller's `variable`, a thread-local one of the static block, which is at
/// one distance from the thread pointer in every storage.
template <class T>
T& instance_for(const Fiber& fiber, T& variable) {
  const auto distance = reinterpret_cast<char*>(&variable) - static_cast<char*>(thread_pointer());
  return *reinterpret_cast<T*>(static_cast<char*>(storage_of(fiber)) + distance);
}

}  // namespace waitpoint::kernel
