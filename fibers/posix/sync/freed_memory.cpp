// SPDX-License-Identifier: BSD-3-Clause
//
// Memory that the program frees: primitives in it are used no more. The runtime for -fsanitize=thread has functions of
// these names, which call the first one below.
#include <dlfcn.h>

#include <cstddef>
#include <cstdlib>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/thread.hpp"

using namespace waitpoint::posix;

namespace {

// The allocator that the program has.
struct Allocator {
  void (*free)(void*) = nullptr;
  std::size_t (*size)(void*) = nullptr;  ///< null: it has no such function, and the C library's is for other memory
};

// Empty within the look-up, which may free memory: a few bytes, which are lost then.
const Allocator& the_allocator() {
  static constinit Allocator known;
  static constinit bool is_looked_up = false;
  if (is_looked_up) return known;
  is_looked_up = true;
  const auto look_up = reinterpret_cast<void* (*)(void*, const char*)>(waitpoint_own_dlsym());
  void* const free_of_program = look_up(RTLD_NEXT, "free");
  void* const size_of_program = look_up(RTLD_DEFAULT, "malloc_usable_size");
  if (are_of_one_library(free_of_program, size_of_program))
    known.size = reinterpret_cast<decltype(known.size)>(size_of_program);
  known.free = reinterpret_cast<decltype(known.free)>(free_of_program);
  return known;
}

}  // namespace

extern "C" [[gnu::visibility("hidden")]] void waitpoint_note_freed(void* memory) {
  if (memory == nullptr || !is_simulated()) return;
  const auto size = the_allocator().size;
  if (const Waitable* const awaited = mark_freed(memory, size != nullptr ? size(memory) : 1))
    note_misuse("frees", *awaited, ", awaited by ", awaited->object.first_waiter);
}

/// Before the run, as runs that are put back would each do it again.
extern "C" [[gnu::visibility("hidden")]] void waitpoint_look_up_allocator() { (void)the_allocator(); }

extern "C" [[gnu::visibility("default"), gnu::weak]] void free(void* memory) noexcept {
  const auto free_of_program = the_allocator().free;
  if (free_of_program == nullptr) return;
  waitpoint_note_freed(memory);
  free_of_program(memory);
}
