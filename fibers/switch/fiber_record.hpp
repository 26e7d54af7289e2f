// SPDX-License-Identifier: BSD-3-Clause
// A fiber as a plain struct: its stack, and its copy of per-thread state while another fiber runs.
#pragma once

#include "fibers/switch/stack.hpp"

namespace waitpoint::kernel {

/// Per-thread state of the C++ runtime and the C library, of which every fiber has its own copy.
struct ThreadState {
  void* caught_exceptions = nullptr;
  unsigned int uncaught_exceptions = 0;
  int error_number = 0;
};

struct Fiber {
  void* context = nullptr;  ///< its parked stack pointer; null while it runs. A debugger reads it.
  ThreadState thread_state;
  Stack stack;
  /// The base of its thread-local storage, which includes the per-thread state; null: that of the thread that runs the
  /// fibers.
  void* thread_pointer = nullptr;
  bool ended = false;        ///< it is never entered again
  void* known_as = nullptr;  ///< the sanitizer's handle
};

}  // namespace waitpoint::kernel
