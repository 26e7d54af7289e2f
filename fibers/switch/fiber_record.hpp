// SPDX-License-Identifier: BSD-3-Clause
// A fiber as a plain struct: its stack, and what it has of the thread's state while another one runs.
#pragma once

#include "fibers/switch/stack.hpp"

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

}  // namespace waitpoint::kernel
