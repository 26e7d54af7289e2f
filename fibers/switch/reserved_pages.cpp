// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/switch/reserved_pages.hpp"

#include <sys/mman.h>

#include <utility>

#include "core/error.hpp"

namespace waitpoint::kernel {
namespace {

constexpr std::size_t kept_max = 12;
constinit ReservedPages kept[kept_max] = {};
constinit std::size_t kept_count = 0;
constinit bool keeps = false;

/// Where this thread last released pages: asked for again, since qemu's user mode takes a new address for each mapping
/// and keeps tables for all that it ever had.
constexpr std::size_t released_max = 8;
constinit thread_local ReservedPages released[released_max] = {};
constinit thread_local std::size_t released_count = 0;

// Null, or an address that may be free. The system only takes it for a wish.
void* address_released(std::size_t bytes) {
  for (ReservedPages& pages : released)
    if (pages.bytes == bytes) return std::exchange(pages, {}).memory;
  return nullptr;
}

}  // namespace

void* reserve_pages(std::size_t bytes, int flags) {
  for (std::size_t i = 0; !keeps && i < kept_count; ++i) {
    if (kept[i].is_taken || kept[i].bytes != bytes) continue;
    kept[i].is_taken = true;
    return kept[i].memory;
  }
  void* const memory = mmap(address_released(bytes), bytes, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | flags, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  if (keeps) {
    WAITPOINT_CHECK(kept_count < kept_max, "more pages are kept than there is room for");
    kept[kept_count++] = {memory, bytes, false};
  }
  return memory;
}

void release_pages(void* memory, std::size_t bytes) {
  if (keeps) return;
  munmap(memory, bytes);
  released[released_count++ % released_max] = {memory, bytes, false};
}

PagesKept::PagesKept() {
  WAITPOINT_CHECK(!keeps, "a scope that keeps pages is within another");
  keeps = true;
}
PagesKept::~PagesKept() { keeps = false; }

std::span<const ReservedPages> kept_pages() { return {kept, kept_count}; }

}  // namespace waitpoint::kernel
