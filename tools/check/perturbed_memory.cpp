// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/perturbed_memory.hpp"

#include <alloca.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>

namespace waitpoint::tools {
namespace {

constexpr unsigned char fill = 0xB7;

std::uint64_t address(const void* at) { return reinterpret_cast<std::uint64_t>(at); }

// The address of an object in each part of a program's address space.
SharedPage surroundings_page() {
  const std::unique_ptr<char> on_heap(new char);
  SharedPage page;
  page.calendar_s = std::time(nullptr);
  page.stack = address(__builtin_frame_address(0));
  page.heap = address(on_heap.get());
  page.library = address(stdout);
  return page;
}

// The caller's next calls find no zeroed stack memory.
__attribute__((noinline)) void fill_below() {
  unsigned char below[256 << 10];
  std::memset(below, fill, sizeof below);
  asm volatile("" : : "r"(below) : "memory");  // prevents removal as unused
}

}  // namespace

void with_perturbed_stack(void (*run)(void*), void* argument) {
  constexpr std::size_t shift = 40'976;
  fill_below();
  void* const moved = alloca(shift);
  asm volatile("" : : "r"(moved) : "memory");
  run(argument);
}

// Leaves its own frame and its callees alone: it calls nothing. Sanitizers are disabled.
#if defined(__clang__)
__attribute__((noinline, no_sanitize("address", "thread", "undefined")))
#else
__attribute__((noinline, no_sanitize_address, no_sanitize_thread, no_sanitize_undefined))
#endif
void fill_stack(const kernel::Task& task) {
  constexpr std::size_t most = 16 << 10, own = 512, canary = 64;
  char* const high = static_cast<char*>(__builtin_frame_address(0)) - own;
  char* const low = task.fiber.stack.low + canary;
  if (high <= low) return;
  for (volatile char* at = high - std::min(most, static_cast<std::size_t>(high - low)); at < high; ++at)
    *at = static_cast<char>(fill);
}

void note_surroundings(SharedPage& page) {
  const SharedPage here = surroundings_page();
  page.calendar_s = here.calendar_s;
  page.stack = here.stack;
  page.heap = here.heap;
  page.library = here.library;
}

void compare_surroundings(SharedPage& page) {
  const SharedPage here = surroundings_page();
  page.moved = here.stack != page.stack && here.heap != page.heap && here.library != page.library;
  page.surrounded = here.calendar_s < page.calendar_s;
}

}  // namespace waitpoint::tools
