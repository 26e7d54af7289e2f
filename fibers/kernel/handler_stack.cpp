// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/handler_stack.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>

#include "fibers/switch/reserved_pages.hpp"

namespace waitpoint::kernel {
namespace {

constexpr std::size_t stack_size = std::size_t{1024} * 1024;

// The first thread's; others have reserved pages.
alignas(64) char first_stack[stack_size];
std::atomic<bool> is_first_taken = false;

// Model code's calls of the C library's function are refused (tools/run/signal_calls.cpp).
void set_stack(const stack_t& stack, stack_t* before) { syscall(SYS_sigaltstack, &stack, before); }

}  // namespace

HandlerStack::HandlerStack() : memory_(is_first_taken.exchange(true) ? reserve_pages(stack_size) : first_stack) {
  if (memory_ == nullptr) return;
  stack_t stack{};
  stack.ss_sp = memory_;
  stack.ss_size = stack_size;
  set_stack(stack, &previous_);
}

HandlerStack::~HandlerStack() {
  if (memory_ == nullptr) return;
  set_stack(previous_, nullptr);
  if (memory_ == first_stack)
    is_first_taken = false;
  else
    release_pages(memory_, stack_size);
}

}  // namespace waitpoint::kernel
