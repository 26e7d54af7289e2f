// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/calendar.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "fibers/kernel/fetch.hpp"

namespace waitpoint::kernel {
namespace {

bool earlier(const EventEntry& a, const EventEntry& b) { return a.key < b.key; }

// Newest first, as a bucket's list has them. Events put in for one instant came in their order, mostly.
void sort(EventEntry* first, EventEntry* last) {
  std::reverse(first, last);
  if (last - first > 24) {
    if (!std::is_sorted(first, last, earlier)) std::sort(first, last, earlier);
    return;
  }
  for (EventEntry* next = first + 1; next < last; ++next) {
    const EventEntry entry = *next;
    EventEntry* at = next;
    for (; at > first && entry.key < at[-1].key; --at) *at = at[-1];
    *at = entry;
  }
}

}  // namespace

Calendar::Calendar(std::uint32_t capacity) : reserved_(bytes(capacity)) {
  const std::size_t slots = slots_bytes(capacity);
  void* memory = mmap(nullptr, reserved_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  WAITPOINT_CHECK(memory != MAP_FAILED, "no address space for the event list");
  slots_ = static_cast<Slot*>(memory);
  heads_ = reinterpret_cast<std::uint32_t*>(static_cast<char*>(memory) + slots);
  occupied_ = reinterpret_cast<std::uint64_t*>(static_cast<char*>(memory) + slots + heads_bytes);
}

Calendar::~Calendar() { munmap(slots_, reserved_); }

void Calendar::unlink(std::uint32_t slot) {
  const Slot& gone = slots_[slot];
  const std::uint64_t number = bucket_of(gone.key);
  --(number < limit_ ? in_ring_ : in_far_);
  if (gone.next != none) slots_[gone.next].previous = gone.previous;
  if ((gone.previous & first_tag) == 0) {
    slots_[gone.previous].next = gone.next;
    return;
  }
  const std::uint32_t bucket = gone.previous & ~first_tag;
  heads_[bucket] = gone.next;
  if (gone.next == none && bucket != far_bucket) clear(bucket);
}

std::uint32_t Calendar::detach_all() {
  std::uint32_t chain = none;
  const auto take = [&](std::uint32_t bucket) {
    for (std::uint32_t slot = heads_[bucket]; slot != none;) {
      const std::uint32_t next = slots_[slot].next;
      slots_[slot].next = chain;
      chain = slot;
      slot = next;
    }
    heads_[bucket] = none;
  };
  for (std::uint32_t word = 0; word <= mask_ / 64; ++word)
    for (; occupied_[word] != 0; occupied_[word] &= occupied_[word] - 1)
      take(word * 64 + static_cast<std::uint32_t>(std::countr_zero(occupied_[word])));
  take(far_bucket);
  in_ring_ = in_far_ = 0;
  far_least_ = ~std::uint64_t{0};
  return chain;
}

std::uint64_t Calendar::next_occupied(std::uint64_t number) const {
  for (; number < limit_; number = (number | 63) + 1) {
    const std::uint64_t word = occupied_[(number & mask_) / 64] >> number % 64;
    if (word != 0) return number + static_cast<std::uint64_t>(std::countr_zero(word));
  }
  return limit_;
}

void Calendar::move_limit() {
  const std::uint64_t half = mask_ / 2 + 1;
  limit_ = (cursor_ / half + 2) * half;
}

void Calendar::sort_far_out() {
  std::uint32_t slot = heads_[far_bucket];
  heads_[far_bucket] = none;
  in_far_ = 0;
  far_least_ = ~std::uint64_t{0};
  while (slot != none) {
    const std::uint32_t next = slots_[slot].next;
    link(slot);
    slot = next;
  }
}

std::uint32_t Calendar::take_next(EventEntry* to) {
  if (size() == 0) return 0;
  // Where the ring is empty, the cursor goes on to the far events at once.
  while (in_ring_ == 0) {
    if (far_least_ > cursor_) cursor_ = far_least_;
    move_limit();
    sort_far_out();
  }
  cursor_ = next_occupied(cursor_);
  const std::uint32_t bucket = static_cast<std::uint32_t>(cursor_) & mask_;
  std::uint32_t count = 0;
  for (std::uint32_t slot = heads_[bucket]; slot != none; ++count) {
    to[count] = {slots_[slot].key, slots_[slot].node};
    slots_[slot].previous = taken;
    slot = slots_[slot].next;
  }
  heads_[bucket] = none;
  clear(bucket);
  in_ring_ -= count;
  ++cursor_;
  horizon_ = cursor_ << shift_;
  if (limit_ - cursor_ < mask_ / 2 + 1) {
    move_limit();
    sort_far_out();
  }
  sort(to, to + count);
  return count;
}

void Calendar::prepare_next(std::uint32_t buckets) const {
  std::uint64_t number = cursor_;
  for (std::uint32_t i = 0; i < buckets; ++i, ++number) {
    number = next_occupied(number);
    if (number == limit_) return;
    fetch(&slots_[heads_[static_cast<std::uint32_t>(number) & mask_]]);
  }
}

}  // namespace waitpoint::kernel
