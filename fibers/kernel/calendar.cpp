// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/calendar.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "fibers/switch/reserved_pages.hpp"

namespace waitpoint::kernel {
namespace {

// Up to this number of events, a bucket is sorted without distribution into parts.
constexpr std::uint32_t few = 6;
// A part of a bucket with more events is sorted separately.
constexpr std::uint32_t crowd = 16;

bool earlier(const EventEntry& a, const EventEntry& b) { return a.key < b.key; }

// Insertion sort: fast if each entry is near its place.
void sort_nearly_sorted(EventEntry* first, EventEntry* last) {
  for (EventEntry* next = first + 1; next < last; ++next) {
    if (!(next->key < next[-1].key)) continue;
    const EventEntry entry = *next;
    EventEntry* at = next;
    for (; at > first && entry.key < at[-1].key; --at) *at = at[-1];
    *at = entry;
  }
}

// Events of one instant are mostly inserted in their order.
void sort_crowd(EventEntry* first, EventEntry* last) {
  if (!std::is_sorted(first, last, earlier)) std::sort(first, last, earlier);
}

}  // namespace

Calendar::Calendar(std::uint32_t capacity) : reserved_(bytes(capacity)) {
  void* const memory = reserve_pages(reserved_);
  WAITPOINT_CHECK(memory != nullptr, "no address space for the event list");
  chunks_ = static_cast<Chunk*>(memory);
  buckets_ = reinterpret_cast<Bucket*>(chunks_ + chunks(capacity));
  occupied_ = reinterpret_cast<std::uint64_t*>(reinterpret_cast<char*>(buckets_) + heads_bytes);
  ends_ = reinterpret_cast<std::uint32_t*>(occupied_ + buckets_max / 64);
}

Calendar::~Calendar() { release_pages(chunks_, reserved_); }

void Calendar::add_chunk(Bucket& to, std::uint32_t bucket) {
  std::uint32_t chunk = free_;
  if (chunk != none)
    free_ = chunks_[chunk].next;
  else
    chunk = ++opened_;
  if (to.newest != none)
    chunks_[to.newest].filled = chunk_size;
  else if (bucket != far_bucket)
    mark(bucket);
  chunks_[chunk].next = to.newest;
  to = {chunk, 0};
}

void Calendar::remove(const EventNode& node) {
  const std::uint64_t number = bucket_of(entry_at(node.index()).key);
  const bool is_far = number >= limit_;
  --(is_far ? in_far_ : in_ring_);
  take_out(is_far ? far_bucket : static_cast<std::uint32_t>(number) & mask_, node.index());
}

// Moves the last entry to the free place, so that all chunks but the newest stay full.
void Calendar::take_out(std::uint32_t bucket, std::uint32_t place) {
  Bucket& from = buckets_[bucket];
  EventEntry& gone = entry_at(place);
  const EventEntry& last = chunks_[from.newest].entries[--from.filled];
  if (&gone != &last) {
    gone = last;
    gone.node->place = EventNode::in_calendar(place);
  }
  if (from.filled > 0) return;
  const std::uint32_t older = chunks_[from.newest].next;
  release(from.newest);
  from = {older, older != none ? chunk_size : 0};
  if (older == none && bucket != far_bucket) clear(bucket);
}

std::uint32_t Calendar::detach(std::uint32_t bucket) {
  Bucket& from = buckets_[bucket];
  if (from.newest != none) chunks_[from.newest].filled = from.filled;
  std::uint32_t chain = none;
  for (std::uint32_t chunk = from.newest; chunk != none;) {
    const std::uint32_t older = chunks_[chunk].next;
    chunks_[chunk].next = chain;
    chain = chunk;
    chunk = older;
  }
  from = {none, 0};
  if (bucket != far_bucket) clear(bucket);
  return chain;
}

std::uint32_t Calendar::detach_all() {
  std::uint32_t all = detach(far_bucket);
  for (std::uint32_t word = 0; word <= mask_ / 64; ++word) {
    while (occupied_[word] != 0) {
      const std::uint32_t bucket = word * 64 + static_cast<std::uint32_t>(std::countr_zero(occupied_[word]));
      const std::uint32_t last = buckets_[bucket].newest;
      const std::uint32_t chain = detach(bucket);
      chunks_[last].next = all;
      all = chain;
    }
  }
  in_ring_ = in_far_ = 0;
  far_least_ = ~std::uint64_t{0};
  return all;
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

// Remaining entries are not written, and their nodes not read. Iterates backwards: the entry that fills a free place
// has been visited already, and remains.
void Calendar::take_near_ones_out_of_far() {
  far_least_ = ~std::uint64_t{0};
  std::uint32_t filled = buckets_[far_bucket].filled;
  for (std::uint32_t chunk = buckets_[far_bucket].newest; chunk != none; filled = chunk_size) {
    const std::uint32_t older = chunks_[chunk].next;
    for (std::uint32_t i = filled; i-- > 0;) {
      const EventEntry entry = chunks_[chunk].entries[i];
      const std::uint64_t number = bucket_of(entry.key);
      if (number >= limit_) {
        far_least_ = std::min(far_least_, number);
        continue;
      }
      take_out(far_bucket, chunk << chunk_index_bits | i);
      --in_far_;
      insert(*entry.node, entry.key);
    }
    chunk = older;
  }
}

std::uint32_t Calendar::take_next(EventEntry* to) {
  if (size() == 0) return 0;
  // If the ring is empty, the cursor jumps to the far events.
  while (in_ring_ == 0) {
    if (far_least_ > cursor_) cursor_ = far_least_;
    move_limit();
    take_near_ones_out_of_far();
  }
  cursor_ = next_occupied(cursor_);
  const std::uint32_t bucket = static_cast<std::uint32_t>(cursor_) & mask_;
  const std::uint32_t last = buckets_[bucket].newest;
  const std::uint32_t first = detach(bucket);
  const std::uint32_t count = copy_sorted(first, to);
  chunks_[last].next = free_;
  free_ = first;
  in_ring_ -= count;
  ++cursor_;
  horizon_ = cursor_ << shift_;
  if (limit_ - cursor_ < mask_ / 2 + 1) {
    move_limit();
    take_near_ones_out_of_far();
  }
  return count;
}

// The number of the chunks' events, copied, if they are sorted already: tasks that are due together were mostly
// inserted in their order. Otherwise 0, at the first inversion.
std::uint32_t Calendar::copy_if_sorted(std::uint32_t first, EventEntry* to) const {
  EventEntry* end = to;
  EventKey last{};
  for (std::uint32_t chunk = first; chunk != none; chunk = chunks_[chunk].next) {
    const EventEntry* const entries = chunks_[chunk].entries;
    for (std::uint32_t i = 0; i < chunks_[chunk].filled; ++i) {
      if (entries[i].key < last) return 0;
      last = entries[i].key;
      *end++ = entries[i];
    }
  }
  return static_cast<std::uint32_t>(end - to);
}

// Distributes the events to about as many equal parts of the bucket's span; the final insertion sort then moves little.
std::uint32_t Calendar::copy_sorted(std::uint32_t first, EventEntry* to) {
  std::uint32_t count = copy_if_sorted(first, to);
  if (count != 0) return count;
  for (std::uint32_t chunk = first; chunk != none; chunk = chunks_[chunk].next) count += chunks_[chunk].filled;
  if (count <= few) {
    std::copy_n(chunks_[first].entries, count, to);
    sort_nearly_sorted(to, to + count);
    return count;
  }
  const unsigned parts_log2 = std::min({static_cast<unsigned>(std::bit_width(count)), parts_log2_max, shift_});
  const std::uint32_t parts = 1u << parts_log2;
  const auto part_of = [shift = shift_ - parts_log2, mask = parts - 1](const EventEntry& entry) {
    return static_cast<std::uint32_t>(entry.key.due_ns() >> shift) & mask;
  };
  std::uint32_t* const ends = ends_;
  std::memset(ends, 0, parts * sizeof *ends);
  for (std::uint32_t chunk = first; chunk != none; chunk = chunks_[chunk].next)
    for (std::uint32_t i = 0; i < chunks_[chunk].filled; ++i) ++ends[part_of(chunks_[chunk].entries[i])];
  std::uint32_t sum = 0, most = 0;
  for (std::uint32_t part = 0; part < parts; ++part) {
    most = std::max(most, ends[part]);
    sum += std::exchange(ends[part], sum);
  }
  for (std::uint32_t chunk = first; chunk != none; chunk = chunks_[chunk].next)
    for (std::uint32_t i = 0; i < chunks_[chunk].filled; ++i)
      to[ends[part_of(chunks_[chunk].entries[i])]++] = chunks_[chunk].entries[i];
  if (most > crowd)
    for (std::uint32_t part = 0, begin = 0; part < parts; begin = ends[part++])
      if (ends[part] - begin > crowd) sort_crowd(to + begin, to + ends[part]);
  sort_nearly_sorted(to, to + count);
  return count;
}

}  // namespace waitpoint::kernel
