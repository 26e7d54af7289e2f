// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/switch/fiber.hpp"

#include <boost/context/detail/fcontext.hpp>
#include <cerrno>

#include "core/error.hpp"
#include "core/instructions.hpp"
#include "fibers/switch/runtime_state.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/switch/thread_pointer.hpp"

// Part of the Itanium C++ ABI, but not declared by libc++'s <cxxabi.h>.
namespace __cxxabiv1 {
struct __cxa_eh_globals;
extern "C" __cxa_eh_globals* __cxa_get_globals() noexcept;
}  // namespace __cxxabiv1

namespace waitpoint::kernel {
namespace {

namespace context = boost::context::detail;

// The argument of the first switch to make_fcontext's function.
struct Start {
  Fiber& fiber;
  void (*entry)(void*);
  void* argument;
};

// The switch, annotated for sanitizers.
[[gnu::noinline]] void jump_seen(Fiber& from, Fiber& to) {
  const Departure away = departure(from, to);
  sanitizer::leave(from, to);
  Fiber& left = note_where_left(depart(away));
  sanitizer::arrive(left, from);
}

inline void jump(Fiber& from, Fiber& to) {
  if (__builtin_expect(sanitizer::present, 0)) return jump_seen(from, to);
  note_where_left(depart(departure(from, to)));
}

// Switches back to prepare(), with the context to continue in. The fiber is entered by depart(), which does not restore
// all registers: hence the clobbers. The frame is that of depart(), since that of jump_fcontext differs between
// versions of Boost.
#if WAITPOINT_X86_64
context::transfer_t wait_to_begin(context::fcontext_t maker) {
  context::transfer_t came{};
  asm volatile(WAITPOINT_PUSH_FRAME
               "movq %%rsp, %%rsi\n\t"
               "call jump_fcontext@PLT\n"
               "1:"
               : "=a"(came.fctx), "=d"(came.data), "+D"(maker)
               :
               : "rcx", "rsi", "r8", "r9", "r10", "r11", "r12", "r13", "r14", "r15", "memory", "cc");
  return came;
}
context::fcontext_t context_of(const context::transfer_t& waiting) { return waiting.data; }
#else
context::transfer_t wait_to_begin(context::fcontext_t maker) { return context::jump_fcontext(maker, nullptr); }
context::fcontext_t context_of(const context::transfer_t& waiting) { return waiting.fctx; }
#endif

// In the outermost frame of a fiber: debuggers and unwinders stop here.
#if defined(__x86_64__)
#define WAITPOINT_OUTERMOST_FRAME asm volatile(".cfi_undefined rip")
#elif defined(__aarch64__)
#define WAITPOINT_OUTERMOST_FRAME asm volatile(".cfi_undefined x30")
#else
#define WAITPOINT_OUTERMOST_FRAME
#endif

void run_entry(context::transfer_t transfer) {
  WAITPOINT_OUTERMOST_FRAME;
  // prepare() switches here once, so that Start can be read from its frame; the next switch starts the fiber.
  const Start start = *static_cast<const Start*>(transfer.data);
  transfer = wait_to_begin(transfer.fctx);
  Fiber& left = note_where_left({transfer.fctx, transfer.data});
  if (sanitizer::present) sanitizer::arrive(left, start.fiber);
  start.entry(start.argument);
  bug(__FILE__, __LINE__, "entry returned", "a fiber's entry function returned");
}

}  // namespace

constinit thread_local RuntimeState runtime_state;

void bind_to_thread() {
  runtime_state.exceptions = reinterpret_cast<RuntimeState::Exceptions*>(__cxxabiv1::__cxa_get_globals());
  runtime_state.error_number = &errno;
  runtime_state.thread_pointer = thread_pointer();
}

void* storage_of(const Fiber& fiber) {
  return fiber.thread_pointer != nullptr ? fiber.thread_pointer : runtime_state.thread_pointer;
}

void prepare(Fiber& fiber, const Stack& stack, char* top, void (*entry)(void*), void* argument) {
  fiber.stack = stack;
  fiber.thread_state = {};
  if (sanitizer::present) sanitizer::prepare(fiber);
  Start start{fiber, entry, argument};
  context::fcontext_t fresh = context::make_fcontext(top, static_cast<std::size_t>(top - stack.low), run_entry);
  fiber.context = context_of(context::jump_fcontext(fresh, &start));
}

void switch_fiber(Fiber& from, Fiber& to) {
  runtime_state.exchange(from, to);
  jump(from, to);
}

void switch_fiber_and_storage(Fiber& from, Fiber& to) {
  if (from.thread_pointer == nullptr) runtime_state.save(from);
  if (to.thread_pointer == nullptr) runtime_state.restore(to);
  instance_for(to, runtime_state) = runtime_state;
  // No thread-local variable is used from here to the switch: its address may be that in the storage that is left.
  set_thread_pointer(storage_of(to));
  jump(from, to);
}

#if !WAITPOINT_X86_64
Arrival depart(Departure away) {
  const context::transfer_t came = context::jump_fcontext(away.context, reinterpret_cast<void*>(away.how_else));
  return {came.fctx, came.data};
}
#endif

}  // namespace waitpoint::kernel
