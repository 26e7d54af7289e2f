// SPDX-License-Identifier: BSD-3-Clause
// The first part of a switch: exchanges the per-thread state of the C++ runtime and the C library for that of the
// entered fiber. For the kernel's own sources.
#pragma once

#include "fibers/switch/departure.hpp"
#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

/// Addresses of the state of the thread that runs the fibers, cached since the look-up costs as much as the switch. The
/// thread's own.
struct RuntimeState {
  // The Itanium C++ ABI fixes the first two members of the record that __cxa_get_globals returns.
  struct Exceptions {
    void* caught;
    unsigned int uncaught;
  };

  Exceptions* exceptions = nullptr;
  int* error_number = nullptr;
  void* thread_pointer = nullptr;

  ThreadState now() const { return {exceptions->caught, exceptions->uncaught, *error_number}; }
  void save(Fiber& fiber) const { fiber.thread_state = now(); }
  void restore(const Fiber& fiber) const { set(fiber.thread_state); }
  // Mostly the state is unchanged and not written: a switch is bound by its writes.
  void exchange(Fiber& from, const Fiber& to) const {
    const ThreadState state = now();
    if (__builtin_expect(differ(state, from.thread_state), 0)) from.thread_state = state;
    if (__builtin_expect(differ(state, to.thread_state), 0)) set(to.thread_state);
  }

 private:
  void set(const ThreadState& state) const {
    exceptions->caught = state.caught_exceptions;
    exceptions->uncaught = state.uncaught_exceptions;
    *error_number = state.error_number;
  }
  // Compares all members without branches.
  static bool differ(const ThreadState& a, const ThreadState& b) {
    const auto caught =
        reinterpret_cast<std::uintptr_t>(a.caught_exceptions) ^ reinterpret_cast<std::uintptr_t>(b.caught_exceptions);
    const auto uncaught = a.uncaught_exceptions ^ b.uncaught_exceptions;
    const auto error = static_cast<unsigned>(a.error_number) ^ static_cast<unsigned>(b.error_number);
    return (caught | uncaught | error) != 0;
  }
};
[[gnu::tls_model("initial-exec")]] extern constinit thread_local RuntimeState runtime_state;

inline Departure departure(Fiber& from, Fiber& to) {
  void* const context = to.context;
  to.context = nullptr;
  return {context, reinterpret_cast<std::uintptr_t>(&from)};
}

/// A switch in two parts, see departure.hpp: for fibers with the same thread-local storage, without a sanitizer.
inline bool can_switch_in_parts(const Fiber& from, const Fiber& to) { return from.thread_pointer == to.thread_pointer; }
inline Departure start_switch(Fiber& from, Fiber& to) {
  runtime_state.exchange(from, to);
  return departure(from, to);
}

}  // namespace waitpoint::kernel
