// SPDX-License-Identifier: BSD-3-Clause
//
// Memory that the program frees: primitives in it are used no more. The runtime for -fsanitize=thread has functions of
// these names, which call the first one below.
#include <malloc.h>

#include <cstdlib>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/thread.hpp"

using namespace waitpoint::posix;

extern "C" [[gnu::visibility("hidden")]] void waitpoint_note_freed(void* memory) {
  if (memory == nullptr || !is_simulated()) return;
  if (const Waitable* const awaited = mark_freed(memory, malloc_usable_size(memory)))
    note_misuse("frees", *awaited, ", awaited by ", awaited->object.first_waiter);
}

// Of the allocator that the program has. The look-up may free memory: a few bytes, which are lost then.
extern "C" [[gnu::visibility("default"), gnu::weak]] void free(void* memory) noexcept {
  using Free = void (*)(void*);
  static constinit Free known = nullptr;
  static constinit bool is_looked_up = false;
  if (known == nullptr && !is_looked_up) {
    is_looked_up = true;
    const auto look_up = reinterpret_cast<void* (*)(void*, const char*)>(waitpoint_own_dlsym());
    known = reinterpret_cast<Free>(look_up(RTLD_NEXT, "free"));
  }
  if (known == nullptr) return;
  waitpoint_note_freed(memory);
  known(memory);
}
