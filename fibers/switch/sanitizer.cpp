// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/switch/sanitizer.hpp"

#include <sys/mman.h>

#include <cstdint>

#include "core/error.hpp"
#include "core/instructions.hpp"
#include "fibers/switch/fiber_record.hpp"

// The runtimes' public interfaces (sanitizer/*_interface.h); a program has at most one of them.
extern "C" {
#define WAITPOINT_WEAK __attribute__((weak))
WAITPOINT_WEAK void __sanitizer_start_switch_fiber(void** fake_stack_save, const void* bottom, std::size_t size);
WAITPOINT_WEAK void __sanitizer_finish_switch_fiber(void* fake_stack, const void** bottom_old, std::size_t* size_old);
WAITPOINT_WEAK void __asan_unpoison_memory_region(const volatile void* address, std::size_t size);
WAITPOINT_WEAK void __lsan_register_root_region(const void* begin, std::size_t size);
WAITPOINT_WEAK void __lsan_unregister_root_region(const void* begin, std::size_t size);
WAITPOINT_WEAK void* __tsan_get_current_fiber();
WAITPOINT_WEAK void* __tsan_create_fiber(unsigned flags);
WAITPOINT_WEAK void __tsan_destroy_fiber(void* fiber);
WAITPOINT_WEAK void __tsan_switch_to_fiber(void* fiber, unsigned flags);
WAITPOINT_WEAK void __tsan_set_fiber_name(void* fiber, const char* name);
WAITPOINT_WEAK void __tsan_acquire(void* address);
WAITPOINT_WEAK void __tsan_release(void* address);
// The interface of this project's runtime for -fsanitize=thread: fibers/explore/races.
WAITPOINT_WEAK void waitpoint_races_open_run();
WAITPOINT_WEAK void waitpoint_races_close_run();
WAITPOINT_WEAK void waitpoint_races_forget(const void* low, std::size_t size);
WAITPOINT_WEAK void waitpoint_races_use(const void* object);
WAITPOINT_WEAK void waitpoint_races_read(const void* word, std::size_t size);
WAITPOINT_WEAK void waitpoint_races_barrier();
#undef WAITPOINT_WEAK
}

namespace waitpoint::kernel::sanitizer {

bool present = false;

namespace {

bool address = false;
bool thread = false;
bool own_races = false;  // this project's runtime is linked: it orders the outside context itself
bool valgrind = false;

// The bounds of the outside context's stack, which is not from the arena. AddressSanitizer needs the bounds of every
// stack entered, and returns those of the stack left.
// The thread's own, as the context.
constinit thread_local const void* outside_low = nullptr;
constinit thread_local std::size_t outside_size = 0;

// Addresses that represent the thread's outside context to ThreadSanitizer.
constinit thread_local char from_outside = 0, to_outside = 0;

constexpr unsigned without_synchronization = 1;  // a switch does not synchronise

bool is_outside(const Fiber& fiber) { return fiber.stack.low == nullptr; }

// valgrind's client requests, as in its manual: a sequence of rotations without effect on a processor. Of x86-64 only:
// elsewhere valgrind is not told of stacks.
constexpr std::uint64_t running_on_valgrind = 0x1001, register_stack = 0x1501, deregister_stack = 0x1502;

std::uint64_t ask_valgrind(std::uint64_t request, std::uint64_t first = 0, std::uint64_t second = 0) {
  std::uint64_t answer = 0;
#if WAITPOINT_X86_64
  const volatile std::uint64_t arguments[6] = {request, first, second, 0, 0, 0};
  asm volatile("rolq $3, %%rdi; rolq $13, %%rdi; rolq $61, %%rdi; rolq $51, %%rdi; xchgq %%rbx, %%rbx"
               : "=d"(answer)
               : "a"(arguments), "0"(answer)
               : "cc", "memory");
#else
  static_cast<void>(request), static_cast<void>(first), static_cast<void>(second);
#endif
  return answer;
}

std::size_t size_of(const Stack& stack) { return static_cast<std::size_t>(stack.high - stack.low); }

}  // namespace

void look() {
  address = &__sanitizer_start_switch_fiber != nullptr && &__asan_unpoison_memory_region != nullptr;
  thread = &__tsan_switch_to_fiber != nullptr;
  own_races = &waitpoint_races_use != nullptr;
  valgrind = ask_valgrind(running_on_valgrind) != 0;
  present = address || thread || valgrind;
}

void begin_run() {
  if (&waitpoint_races_open_run != nullptr) waitpoint_races_open_run();
}

void end_run() {
  if (&waitpoint_races_close_run != nullptr) waitpoint_races_close_run();
}

void open_stack(const Stack& stack) {
  if (&waitpoint_races_forget != nullptr) return waitpoint_races_forget(stack.low, size_of(stack));
  if (address) {
    __asan_unpoison_memory_region(stack.low, size_of(stack));
    // Objects referenced only from a parked task's stack are not leaks.
    if (&__lsan_register_root_region != nullptr) __lsan_register_root_region(stack.low, size_of(stack));
  }
  // A new mapping makes ThreadSanitizer discard the history of accesses.
  if (thread) {
    const std::size_t whole_pages = (size_of(stack) + 4095) / 4096 * 4096;
    const void* anew = mmap(stack.low, whole_pages, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK | MAP_FIXED, -1, 0);
    WAITPOINT_CHECK(anew == stack.low, "a stack cannot be mapped anew");
  }
}

void close_stack(const Stack& stack) {
  if (address && &__lsan_unregister_root_region != nullptr) __lsan_unregister_root_region(stack.low, size_of(stack));
}

void prepare(Fiber& fiber) {
  if (thread) fiber.known_as = __tsan_create_fiber(0);
  if (valgrind)
    fiber.known_as =
        reinterpret_cast<void*>(ask_valgrind(register_stack, reinterpret_cast<std::uint64_t>(fiber.stack.low),
                                             reinterpret_cast<std::uint64_t>(fiber.stack.high - 1)));
}

void name(const Fiber& fiber, const char* name) {
  if (thread) __tsan_set_fiber_name(fiber.known_as, name);
}

void leave(Fiber& from, Fiber& to) {
  if (address) {
    const void* low = is_outside(to) ? outside_low : to.stack.low;
    const std::size_t size = is_outside(to) ? outside_size : size_of(to.stack);
    // Null at the fiber's end: AddressSanitizer then frees the frames that it keeps on the heap (fake stack).
    __sanitizer_start_switch_fiber(from.ended ? nullptr : &from.known_as, low, size);
  }
  if (thread) {
    if (is_outside(from)) from.known_as = __tsan_get_current_fiber();
    if (!own_races) __tsan_release(is_outside(from) ? &from_outside : &to_outside);
    __tsan_switch_to_fiber(to.known_as, without_synchronization);
  }
}

void arrive(Fiber& left, Fiber& here) {
  if (address) {
    const void* low = nullptr;
    std::size_t size = 0;
    __sanitizer_finish_switch_fiber(here.known_as, &low, &size);
    if (is_outside(left)) {
      outside_low = low;
      outside_size = size;
    }
  }
  if (thread) {
    if (!own_races) __tsan_acquire(is_outside(here) ? &to_outside : &from_outside);
    if (left.ended) __tsan_destroy_fiber(left.known_as);
  }
  if (valgrind && left.ended) ask_valgrind(deregister_stack, reinterpret_cast<std::uint64_t>(left.known_as));
}

void* enter_timer(void*& known_as) {
  if (!thread) return nullptr;
  void* const interrupted = __tsan_get_current_fiber();
  if (known_as == nullptr) {
    known_as = __tsan_create_fiber(0);
    __tsan_set_fiber_name(known_as, "timers");
  }
  __tsan_switch_to_fiber(known_as, without_synchronization);
  if (!own_races) __tsan_acquire(&from_outside);
  return interrupted;
}

void leave_timer(void* interrupted) {
  if (!thread) return;
  if (!own_races) __tsan_release(&to_outside);
  __tsan_switch_to_fiber(interrupted, without_synchronization);
}

void end_timer(void* known_as) {
  if (thread && known_as != nullptr) __tsan_destroy_fiber(known_as);
}

void release(const void* object) {
  if (thread) __tsan_release(const_cast<void*>(object));
}

void acquire(const void* object) {
  if (thread) __tsan_acquire(const_cast<void*>(object));
}

void use(const void* object) {
  if (own_races) return waitpoint_races_use(object);
  if (!thread) return;
  __tsan_acquire(const_cast<void*>(object));
  __tsan_release(const_cast<void*>(object));
}

void read(const void* word, std::size_t size) {
  if (own_races) waitpoint_races_read(word, size);
}

void barrier() {
  if (own_races) waitpoint_races_barrier();
}

}  // namespace waitpoint::kernel::sanitizer
