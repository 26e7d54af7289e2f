// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/fiber.hpp"

#include <boost/context/detail/fcontext.hpp>
#include <cerrno>

#include "core/error.hpp"
#include "fibers/kernel/sanitizer.hpp"
#include "fibers/kernel/thread_pointer.hpp"

// The Itanium C++ ABI has it; libc++'s <cxxabi.h> has not.
namespace __cxxabiv1 {
struct __cxa_eh_globals;
extern "C" __cxa_eh_globals* __cxa_get_globals() noexcept;
}  // namespace __cxxabiv1

namespace waitpoint::kernel {
namespace {

namespace context = boost::context::detail;

// What make_fcontext's function gets by its first switch.
struct Start {
  Fiber& fiber;
  void (*entry)(void*);
  void* argument;
};

// jump_fcontext comes back by a jump. Were it called, the processor's stack of return addresses would be one too deep
// after each switch, and would mispredict every return from there on. Entered by a jump, it keeps that stack as deep as
// the fibers' own: tasks parked in the same primitive return as predicted. (This file is compiled without a red zone.)
inline context::transfer_t jump(context::fcontext_t to, void* data) {
#ifdef __x86_64__
  context::transfer_t came;
  asm volatile(
      "leaq 1f(%%rip), %%rax\n\t"
      "pushq %%rax\n\t"
      "jmp jump_fcontext@PLT\n"
      "1:"
      : "=a"(came.fctx), "=d"(came.data), "+D"(to), "+S"(data)
      :
      : "rcx", "r8", "r9", "r10", "r11", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9",
        "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15", "memory", "cc");
  return came;
#else
  return context::jump_fcontext(to, data);
#endif
}

// The context of a fiber is known only to whom it switched to: that one writes it down.
Fiber& note_where_left(const context::transfer_t& transfer) {
  Fiber& left = *static_cast<Fiber*>(transfer.data);
  left.context = transfer.fctx;
  return left;
}

// The switch, seen by a sanitizer.
[[gnu::noinline]] void jump_seen(Fiber& from, Fiber& to) {
  void* target = to.context;
  to.context = nullptr;
  sanitizer::leave(from, to);
  Fiber& left = note_where_left(jump(target, &from));
  sanitizer::arrive(left, from);
}

void run_entry(context::transfer_t transfer) {
  // The outermost frame of the fiber: debuggers and unwinders stop here.
  asm volatile(".cfi_undefined rip");
  // prepare() switched here once so that the start could be read from its frame; the first real switch comes after.
  const Start start = *static_cast<const Start*>(transfer.data);
  transfer = context::jump_fcontext(transfer.fctx, nullptr);
  Fiber& left = note_where_left(transfer);
  if (sanitizer::present) sanitizer::arrive(left, start.fiber);
  start.entry(start.argument);
  bug(__FILE__, __LINE__, "entry returned", "a fiber's entry function returned");
}

// The Itanium C++ ABI fixes the first two members of the record that __cxa_get_globals returns.
struct Globals {
  void* caught_exceptions;
  unsigned int uncaught_exceptions;
};

// Of the thread that runs the fibers: looking them up costs as much as the switch.
Globals* globals = nullptr;
int* error_number = nullptr;
void* own_thread_pointer = nullptr;

// What a fiber with a thread pointer of its own has of this is there.
void save_thread_state(Fiber& fiber) {
  fiber.thread_state = {globals->caught_exceptions, globals->uncaught_exceptions, *error_number};
}
void restore_thread_state(const Fiber& fiber) {
  globals->caught_exceptions = fiber.thread_state.caught_exceptions;
  globals->uncaught_exceptions = fiber.thread_state.uncaught_exceptions;
  *error_number = fiber.thread_state.error_number;
}

}  // namespace

void bind_to_thread() {
  globals = reinterpret_cast<Globals*>(__cxxabiv1::__cxa_get_globals());
  error_number = &errno;
  own_thread_pointer = thread_pointer();
}

void prepare(Fiber& fiber, const Stack& stack, char* top, void (*entry)(void*), void* argument) {
  fiber.stack = stack;
  fiber.thread_state = {};
  if (sanitizer::present) sanitizer::prepare(fiber);
  Start start{fiber, entry, argument};
  context::fcontext_t fresh = context::make_fcontext(top, static_cast<std::size_t>(top - stack.low), run_entry);
  fiber.context = context::jump_fcontext(fresh, &start).fctx;
}

void switch_fiber(Fiber& from, Fiber& to) {
  if (__builtin_expect(from.thread_pointer == to.thread_pointer, 1)) {
    save_thread_state(from);
    restore_thread_state(to);
  } else {
    if (from.thread_pointer == nullptr) save_thread_state(from);
    if (to.thread_pointer == nullptr) restore_thread_state(to);
    set_thread_pointer(to.thread_pointer != nullptr ? to.thread_pointer : own_thread_pointer);
  }
  if (__builtin_expect(sanitizer::present, 0)) return jump_seen(from, to);
  void* target = to.context;
  to.context = nullptr;
  note_where_left(jump(target, &from));
}

}  // namespace waitpoint::kernel
