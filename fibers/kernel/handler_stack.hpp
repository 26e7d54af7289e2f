// SPDX-License-Identifier: BSD-3-Clause
// The stack of a thread's signal handlers (sigaltstack), for reports of a death whose cause may be an overrun stack.
// Large enough for the register state of any processor, and for a post mortem; pages that are not used are not there.
#pragma once

#include <csignal>

namespace waitpoint::kernel {

class HandlerStack {
 public:
  /// Of the calling thread. Without memory for it the thread has none.
  HandlerStack();
  /// Restores the thread's previous one.
  ~HandlerStack();
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;

 private:
  void* memory_;
  stack_t previous_{};
};

}  // namespace waitpoint::kernel
