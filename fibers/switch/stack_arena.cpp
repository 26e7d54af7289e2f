// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/switch/stack_arena.hpp"

#include <sys/auxv.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>

#include "core/error.hpp"
#include "fibers/switch/reserved_pages.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {
namespace {

// The least size of a page. Where the system's are too large for guards, this much below the stack is not used.
constexpr std::size_t least_page = 4096;
// The number of different cache lines of a page at which tops of stacks begin: a prime, and small enough that a parked
// task's record and frames are usually in one page.
constexpr std::uint32_t shifts = 53;
constexpr int madv_guard_install = 102;
// A process may have 65 530 mappings by default, and every mprotect-ed page splits one into three.
constexpr std::uint32_t protected_pages_max = 25000;
constexpr std::uint32_t slots_max[stack_sizes] = {1u << 20, 1u << 18, 1u << 14, 1u << 15};

// The free list's link, at the high end, in a page that is in use anyway.
std::uint32_t& link(const Stack& stack) { return reinterpret_cast<std::uint32_t*>(stack.high)[-1]; }

// The greatest range of stacks of one size. If address space is limited (ulimit -v), the rest is left to the heap and
// the run's other tables.
std::size_t bytes_max() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return ~std::size_t{0};
  return limit.rlim_cur / 8;
}

// An emulator of system calls may accept any advice as a hint, and do nothing: qemu's user mode does.
enum class Advice : std::uint8_t { not_asked, ignored, heeded };
constinit std::atomic<Advice> heeds = Advice::not_asked;
bool heeds_advice() {
  constexpr int unknown_advice = 0x7FFF'FFFF;
  if (heeds.load(std::memory_order_relaxed) == Advice::not_asked)
    heeds.store(madvise(nullptr, 0, unknown_advice) != 0 ? Advice::heeded : Advice::ignored, std::memory_order_relaxed);
  return heeds.load(std::memory_order_relaxed) == Advice::heeded;
}

// A guard that needs no mapping of its own.
bool install_light_guard(char* at, std::size_t size) {
  return heeds_advice() && madvise(at, size, madv_guard_install) == 0;
}

// Of each size, of pages that are kept: the first slots have their guards from guard_ahead() on.
struct GuardedAhead {
  const char* base;
  std::uint32_t slots;
};
constinit GuardedAhead guarded_ahead[stack_sizes] = {};

}  // namespace

std::size_t StackArena::system_page_bytes() { return getauxval(AT_PAGESZ); }

StackArena::StackArena(std::size_t page_bytes) : page_bytes_(static_cast<std::uint32_t>(page_bytes)) {
  sanitizer::look();
  for (const StackSize size : {StackSize::small, StackSize::medium, StackSize::large}) reserve(range_of(size), size);
}

void StackArena::reserve_all() {
  if (Range& programs = range_of(StackSize::program); programs.base == nullptr) reserve(programs, StackSize::program);
}

void StackArena::guard_ahead(std::uint32_t slots) {
  for (int i = 0; i < stack_sizes; ++i) {
    guarded_ahead[i] = {ranges_[i].base, 0};
    std::uint32_t& guarded = guarded_ahead[i].slots;
    while (guarded < std::min(slots, ranges_[i].slots) &&
           install_light_guard(ranges_[i].base + guarded * bytes(static_cast<StackSize>(i)), page_bytes_))
      ++guarded;
  }
}

void StackArena::reserve(Range& range, StackSize of) {
  std::size_t most = ~std::size_t{0};
  if (guarded_ahead[static_cast<int>(of)].base == nullptr) most = bytes_max();
  // With little address space (limits, strict overcommit) there are fewer slots, not a failure.
  for (range.slots = slots_max[static_cast<int>(of)]; range.slots > 0; range.slots /= 2) {
    const std::size_t size = range.slots * bytes(of);
    if (size > most) continue;
    void* const base = reserve_pages(size, MAP_STACK);
    if (base == nullptr) continue;
    range.base = static_cast<char*>(base);
    break;
  }
}

StackArena::~StackArena() {
  for (int i = 0; i < stack_sizes; ++i)
    if (ranges_[i].base != nullptr) release_pages(ranges_[i].base, ranges_[i].slots * bytes(static_cast<StackSize>(i)));
}

bool StackArena::install_guard(char* at) {
  if (install_light_guard(at, page_bytes_)) return true;
  if (protected_pages_ >= protected_pages_max || mprotect(at, page_bytes_, PROT_NONE) != 0) return false;
  ++protected_pages_;
  return true;
}

Stack StackArena::describe(const Range& range, StackSize size, std::uint32_t slot) const {
  Stack stack;
  char* base = range.base + slot * bytes(size);
  const std::size_t guard_bytes = is_guarded_by_page(size) ? page_bytes_ : least_page;
  stack.low = base + guard_bytes;
  stack.high = base + bytes(size) - (slot % shifts) * std::size_t{64};
  stack.slot = slot;
  stack.size = size;
  stack.guard = slot < range.unguarded_from ? Guard::page : Guard::canary;
  stack.guard_kib = static_cast<std::uint16_t>(guard_bytes / 1024);
  return stack;
}

bool StackArena::take(StackSize size, Stack& stack) {
  Range& range = range_of(size);
  if (range.base == nullptr && range.slots == 0 && size == StackSize::program) reserve(range, size);
  if (range.free_first != none) {
    stack = describe(range, size, range.free_first);
    range.free_first = link(stack);
  } else {
    if (range.opened == range.slots) return false;
    const std::uint32_t slot = range.opened++;
    const GuardedAhead& ahead = guarded_ahead[static_cast<int>(size)];
    const bool is_guarded = range.base == ahead.base && slot < ahead.slots;
    if (!is_guarded && slot < range.unguarded_from &&
        !(is_guarded_by_page(size) && install_guard(range.base + slot * bytes(size))))
      range.unguarded_from = slot;
    stack = describe(range, size, slot);
  }
  if (sanitizer::present) sanitizer::open_stack(stack);
  if (stack.guard == Guard::canary) canary(stack) = canary_word;
  return true;
}

bool StackArena::guards(const Stack& stack, const char* address) {
  return stack.guard == Guard::page && address < stack.low && address >= stack.low - stack.guard_kib * 1024;
}

void StackArena::give_back(const Stack& stack) {
  WAITPOINT_CHECK(intact(stack), "a task ran over the end of its stack");
  if (sanitizer::present) sanitizer::close_stack(stack);
  Range& range = range_of(stack.size);
  link(stack) = range.free_first;
  range.free_first = stack.slot;
}

}  // namespace waitpoint::kernel
