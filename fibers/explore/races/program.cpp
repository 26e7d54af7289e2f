// SPDX-License-Identifier: BSD-3-Clause
// The functions of the C and C++ libraries that the race runtime replaces: memory management, where memory changes its
// owner outside instrumented code, and the locks of local statics.
#include <malloc.h>
#include <sched.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/detector.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"

// In glibc: allows libstdc++ to count references without atomics.
extern "C" char __libc_single_threaded;

extern "C" {

// glibc's own functions, behind the names that a program may define.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

/// Of the layer under programs, where that is present.
[[gnu::weak, gnu::visibility("hidden")]] void waitpoint_note_freed(void* memory);
[[gnu::weak, gnu::visibility("hidden")]] bool waitpoint_begin_guard(std::uint64_t* guard);
[[gnu::weak, gnu::visibility("hidden")]] void waitpoint_end_guard(std::uint64_t* guard, bool is_made);

void __tsan_init();
int __cxa_guard_acquire(std::uint64_t* guard);
void __cxa_guard_release(std::uint64_t* guard);
void __cxa_guard_abort(std::uint64_t* guard);
}

namespace {

using waitpoint::races::Detector;

// Accesses by the memory's previous owner must not race with the new one's.
void* given(void* memory) {
  if (memory != nullptr && Detector::the().has_current()) Detector::the().forget(memory, malloc_usable_size(memory));
  return memory;
}

// Some code of the program is.
bool is_instrumented = false;

// In a program that is not, guards are the layer's.
bool has_guards_of_layer() { return !is_instrumented && waitpoint_begin_guard != nullptr; }

// The first byte of a guard marks the static as constructed; the second is free for use: construction in progress.
char* made(std::uint64_t* guard) { return reinterpret_cast<char*>(guard); }
char* under_way(std::uint64_t* guard) { return reinterpret_cast<char*>(guard) + 1; }

void leave(std::uint64_t* guard, bool is_made) {
  if (has_guards_of_layer()) return waitpoint_end_guard(guard, is_made);
  if (Detector::the().has_current()) Detector::the().atomic_store(guard, __ATOMIC_RELEASE);
  __atomic_store_n(made(guard), static_cast<char>(is_made), __ATOMIC_RELEASE);
  __atomic_store_n(under_way(guard), 0, __ATOMIC_RELEASE);
}

}  // namespace

extern "C" {

// Called by the constructors of each instrumented object.
void __tsan_init() {
  __libc_single_threaded = 0;
  is_instrumented = true;
}

void* malloc(std::size_t size) { return given(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return given(__libc_calloc(count, size)); }
void* realloc(void* old, std::size_t size) {
  void* memory = __libc_realloc(old, size);
  return memory == old ? memory : given(memory);
}
void* memalign(std::size_t alignment, std::size_t size) { return given(__libc_memalign(alignment, size)); }
void* aligned_alloc(std::size_t alignment, std::size_t size) { return given(__libc_memalign(alignment, size)); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0) return EINVAL;
  void* found = __libc_memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *memory = given(found);
  return 0;
}
void free(void* memory) {
  if (waitpoint_note_freed != nullptr) waitpoint_note_freed(memory);
  __libc_free(memory);
}

// While another task constructs the static, this one yields to it.
int __cxa_guard_acquire(std::uint64_t* guard) {
  if (has_guards_of_layer()) return waitpoint_begin_guard(guard) ? 1 : 0;
  for (;;) {
    if (__atomic_load_n(made(guard), __ATOMIC_ACQUIRE) != 0) {
      if (Detector::the().has_current()) Detector::the().atomic_load(guard, __ATOMIC_ACQUIRE);
      return 0;
    }
    if (__atomic_exchange_n(under_way(guard), 1, __ATOMIC_ACQ_REL) == 0) return 1;
    if (waitpoint::kernel::running == nullptr)
      sched_yield();
    else
      waitpoint::kernel::yield(*waitpoint::kernel::running->scheduler);
  }
}
void __cxa_guard_release(std::uint64_t* guard) { leave(guard, true); }
void __cxa_guard_abort(std::uint64_t* guard) { leave(guard, false); }

}  // extern "C"
