// SPDX-License-Identifier: BSD-3-Clause
// The part of a large event list that is not due soon: buckets of equal spans of time, unsorted until they are due.
//
//              horizon                                       limit
//     time ------|-- bucket --|-- bucket --|-- ... --|-- bucket --|-------- far --------
//      before: others' business       the ring                     one list
//
// The horizon moves on bucket by bucket, the limit by half a ring at a time: then the far list is gone through once.
// Inserting, removing and taking the next bucket cost the same for a thousand events and for a million (R. Brown 1988,
// the calendar queue; W. T. Tang et al. 2005, the ladder queue, for sorting only what is due). The events are in a
// dense pool of their own, not in the tasks' records, of which each would cost a page.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/kernel/event.hpp"

namespace waitpoint::kernel {

class Calendar {
 public:
  /// The address space that one for `capacity` events takes.
  static constexpr std::size_t bytes(std::uint32_t capacity) {
    return slots_bytes(capacity) + heads_bytes + buckets_max / 8;
  }
  /// For at most `capacity` events. Its address space is reserved at once, and committed only as it is used.
  explicit Calendar(std::uint32_t capacity);
  ~Calendar();
  Calendar(const Calendar&) = delete;
  Calendar& operator=(const Calendar&) = delete;

  /// Only events due at the horizon or later belong here; none while it is closed.
  std::uint64_t horizon() const { return horizon_; }
  std::uint32_t size() const { return in_ring_ + in_far_; }
  unsigned width_log2() const { return shift_; }
  std::uint32_t buckets() const { return mask_ + 1; }
  bool is_open() const { return horizon_ != closed; }

  /// Sets the buckets' span to 2^width_log2 ns and their number, a power of two, and the horizon to their first
  /// boundary after `time`, and not before the present one. Events before the new horizon are given back: early(entry).
  template <class Sink>
  void open(std::uint64_t time, unsigned width_log2, std::uint32_t buckets, Sink early);
  /// Gives back all events.
  template <class Sink>
  void close(Sink to);

  void insert(EventNode& node, EventKey key) {
    std::uint32_t slot = free_;
    if (slot != none)
      free_ = slots_[slot].next;
    else
      slot = ++opened_;
    slots_[slot].key = key;
    slots_[slot].node = &node;
    node.place = EventNode::in_calendar(slot);
    link(slot);
  }
  void remove(const EventNode& node) {
    const std::uint32_t slot = node.index();
    unlink(slot);
    release(slot);
  }

  /// Copies the events of the first bucket that has some to `to`, in their order, and moves the horizon behind it.
  /// Returns how many; 0 only if there is none at all. They keep their places until they are released: their nodes,
  /// which lie in as many pages, are not touched.
  std::uint32_t take_next(EventEntry* to);
  /// Has the next `buckets` in the cache by the time they are asked for.
  void prepare_next(std::uint32_t buckets) const;
  bool was_taken(const EventNode& node) const { return slots_[node.index()].previous == taken; }
  const EventKey& key(const EventNode& node) const { return slots_[node.index()].key; }
  /// Ends an event that was taken.
  void release(const EventNode& node) { release(node.index()); }

 private:
  static constexpr std::uint64_t closed = ~std::uint64_t{0};
  static constexpr std::uint32_t none = 0;  // slots are numbered from 1, so that fresh memory reads as empty
  static constexpr std::uint32_t buckets_max = 1u << 21;

  struct Slot {
    EventKey key;
    EventNode* node;
    std::uint32_t next;
    std::uint32_t previous;  // or, of the first of a list, first_of() its bucket; or `taken`
  };
  static constexpr std::size_t heads_bytes = (std::size_t{buckets_max} + 64) * sizeof(std::uint32_t);
  static constexpr std::size_t slots_bytes(std::uint32_t capacity) {
    return (std::size_t{capacity} + 1) * sizeof(Slot);
  }
  static constexpr std::uint32_t first_tag = 1u << 31;
  static constexpr std::uint32_t far_bucket = buckets_max;
  static constexpr std::uint32_t first_of(std::uint32_t bucket) { return first_tag | bucket; }
  static constexpr std::uint32_t taken = 0xFFFFFFFF;

  std::uint64_t bucket_of(const EventKey& key) const { return key.due_ns() >> shift_; }
  void mark(std::uint32_t bucket) { occupied_[bucket / 64] |= std::uint64_t{1} << bucket % 64; }
  void clear(std::uint32_t bucket) { occupied_[bucket / 64] &= ~(std::uint64_t{1} << bucket % 64); }

  void link(std::uint32_t slot) {
    const std::uint64_t number = bucket_of(slots_[slot].key);
    std::uint32_t bucket = far_bucket;
    if (number < limit_) {
      bucket = static_cast<std::uint32_t>(number) & mask_;
      mark(bucket);
      ++in_ring_;
    } else {
      if (number < far_least_) far_least_ = number;
      ++in_far_;
    }
    const std::uint32_t next = heads_[bucket];
    heads_[bucket] = slot;
    slots_[slot].next = next;
    slots_[slot].previous = first_of(bucket);
    if (next != none) slots_[next].previous = slot;
  }
  void unlink(std::uint32_t slot);
  void release(std::uint32_t slot) {
    slots_[slot].next = free_;
    free_ = slot;
  }
  // All slots as one chain.
  std::uint32_t detach_all();
  // The first bucket from `number` on that has events; the limit if there is none.
  std::uint64_t next_occupied(std::uint64_t number) const;
  void move_limit();
  void sort_far_out();

  std::uint64_t horizon_ = closed;
  std::uint64_t cursor_ = 0;     // the bucket that begins at the horizon, counted from the start of the run
  std::uint64_t limit_ = 0;      // a multiple of half the ring, at least that and at most the ring after the cursor
  std::uint64_t far_least_ = 0;  // no far event is in a bucket before this one
  std::uint32_t mask_ = 0;
  unsigned shift_ = 0;
  std::uint32_t in_ring_ = 0;
  std::uint32_t in_far_ = 0;
  std::uint32_t free_ = none;
  std::uint32_t opened_ = 0;
  Slot* slots_;
  std::uint32_t* heads_;  // of the ring's buckets, then of the far list
  std::uint64_t* occupied_;
  std::size_t reserved_;
};

template <class Sink>
void Calendar::open(std::uint64_t time, unsigned width_log2, std::uint32_t buckets, Sink early) {
  const std::uint64_t bound = !is_open() || horizon_ <= time ? time : horizon_ - 1;
  std::uint32_t chain = detach_all();
  shift_ = width_log2;
  mask_ = (buckets < buckets_max ? buckets : buckets_max) - 1;
  cursor_ = (bound >> shift_) + 1;
  horizon_ = cursor_ << shift_;
  move_limit();
  while (chain != none) {
    const std::uint32_t slot = chain;
    chain = slots_[slot].next;
    if (slots_[slot].key.due_ns() >= horizon_) {
      link(slot);
    } else {
      early(EventEntry{slots_[slot].key, slots_[slot].node});
      release(slot);
    }
  }
}

template <class Sink>
void Calendar::close(Sink to) {
  for (std::uint32_t chain = detach_all(); chain != none;) {
    const std::uint32_t slot = chain;
    chain = slots_[slot].next;
    to(EventEntry{slots_[slot].key, slots_[slot].node});
    release(slot);
  }
  horizon_ = closed;
}

}  // namespace waitpoint::kernel
