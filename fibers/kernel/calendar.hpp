// SPDX-License-Identifier: BSD-3-Clause
// The part of a large event list that is not due soon: buckets of equal spans of time, unsorted until they are due.
//
//              horizon                                       limit
//     time ------|-- bucket --|-- bucket --|-- ... --|-- bucket --|-------- far --------
//      before: others' business       the ring                     one bucket more
//
// The horizon moves on bucket by bucket, the limit by half a ring at a time: then the far events are gone through once.
// Inserting, removing and taking the next bucket cost the same for a thousand events and for a million (R. Brown 1988,
// the calendar queue; W. T. Tang et al. 2005, the ladder queue, for sorting only what is due).
//
// Memory decides what that is. A bucket is a chain of chunks, of which only the newest is not full, and buckets are as
// many as events in one, about: so an event is written where the processor has just written for the same bucket, and
// read in a row with the others of its bucket; no step depends on a cache line that was not seen for long. The events
// are apart from the tasks' records, of which each would cost a page.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/kernel/event.hpp"

namespace waitpoint::kernel {

class Calendar {
 public:
  /// The address space that one for `capacity` events takes.
  static constexpr std::size_t bytes(std::uint32_t capacity) {
    return chunks(capacity) * sizeof(Chunk) + heads_bytes + buckets_max / 8 + parts_max * sizeof(std::uint32_t);
  }
  /// For at most `capacity` events. Its address space is reserved at once, and committed only as it is used.
  explicit Calendar(std::uint32_t capacity);
  ~Calendar();
  Calendar(const Calendar&) = delete;
  Calendar& operator=(const Calendar&) = delete;

  /// Only events due at the horizon or later belong here; none while it is closed.
  std::uint64_t horizon() const { return horizon_; }
  std::uint32_t size() const { return in_ring_ + in_far_; }
  std::uint32_t far_size() const { return in_far_; }
  unsigned width_log2() const { return shift_; }
  std::uint32_t buckets() const { return mask_ + 1; }
  bool is_open() const { return horizon_ != closed; }

  /// Sets the buckets' span to 2^width_log2 ns and their number, a power of two from 64 on, and the horizon to their
  /// first boundary after `time`. Events before that are given back: early(entry).
  template <class Sink>
  void open(std::uint64_t time, unsigned width_log2, std::uint32_t buckets, Sink early);
  /// Gives back all events.
  template <class Sink>
  void close(Sink to);

  void insert(EventNode& node, EventKey key) {
    const std::uint64_t number = bucket_of(key);
    std::uint32_t bucket = far_bucket;
    if (number < limit_) {
      bucket = static_cast<std::uint32_t>(number) & mask_;
      ++in_ring_;
    } else {
      if (number < far_least_) far_least_ = number;
      ++in_far_;
    }
    append(bucket, {key, &node});
  }
  void remove(const EventNode& node);

  /// Moves the events of the first bucket that has some to `to`, in their order, and the horizon behind it. Returns how
  /// many; 0 only if there is none at all. The nodes, which lie in as many pages, do not learn of it.
  std::uint32_t take_next(EventEntry* to);

 private:
  static constexpr std::uint64_t closed = ~std::uint64_t{0};
  static constexpr std::uint32_t none = 0;  // chunks are numbered from 1, so that fresh memory reads as empty
  static constexpr std::uint32_t buckets_max = 1u << 14;
  static constexpr unsigned parts_log2_max = 10;
  static constexpr std::uint32_t parts_max = 1u << parts_log2_max;
  static constexpr std::uint32_t chunk_size = 21, chunk_index_bits = 5;

  struct Chunk {
    EventEntry entries[chunk_size];
    std::uint32_t next;    // the one of its bucket that is older; or of those that are free, or detached
    std::uint32_t filled;  // entries, where it is not its bucket's newest
  };
  struct Bucket {
    std::uint32_t newest;  // chunk
    std::uint32_t filled;  // entries of it; 0 only where there is none
  };
  static constexpr std::size_t heads_bytes = (std::size_t{buckets_max} + 1) * sizeof(Bucket) + 56;
  // Full ones, and one of each bucket that is not; while a calendar is opened anew, of the old buckets and the new.
  static constexpr std::size_t chunks(std::uint32_t capacity) {
    return std::size_t{capacity} / chunk_size + 2 * std::size_t{buckets_max} + 3;
  }
  static constexpr std::uint32_t far_bucket = buckets_max;

  std::uint64_t bucket_of(const EventKey& key) const { return key.due_ns() >> shift_; }
  void mark(std::uint32_t bucket) { occupied_[bucket / 64] |= std::uint64_t{1} << bucket % 64; }
  void clear(std::uint32_t bucket) { occupied_[bucket / 64] &= ~(std::uint64_t{1} << bucket % 64); }
  EventEntry& entry_at(std::uint32_t place) {
    return chunks_[place >> chunk_index_bits].entries[place & ((1u << chunk_index_bits) - 1)];
  }

  void append(std::uint32_t bucket, const EventEntry& entry) {
    Bucket& to = buckets_[bucket];
    if (__builtin_expect(to.filled == chunk_size || to.filled == 0, 0)) add_chunk(to, bucket);
    chunks_[to.newest].entries[to.filled] = entry;
    entry.node->place = EventNode::in_calendar(to.newest << chunk_index_bits | to.filled);
    ++to.filled;
  }
  void add_chunk(Bucket& to, std::uint32_t bucket);
  void release(std::uint32_t chunk) {
    chunks_[chunk].next = free_;
    free_ = chunk;
  }
  void take_out(std::uint32_t bucket, std::uint32_t place);
  // The chunks of a bucket, which has none then, linked with the oldest one first.
  std::uint32_t detach(std::uint32_t bucket);
  // Those of all buckets.
  std::uint32_t detach_all();
  // The events of detached chunks: to(entry).
  template <class Sink>
  void give(std::uint32_t chunk, Sink to);
  std::uint32_t copy_sorted(std::uint32_t chunk, EventEntry* to);
  // The first bucket from `number` on that has events; the limit if there is none.
  std::uint64_t next_occupied(std::uint64_t number) const;
  void move_limit();
  void take_near_ones_out_of_far();

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
  Chunk* chunks_;
  Bucket* buckets_;  // of the ring, then that of the far events
  std::uint64_t* occupied_;
  std::uint32_t* ends_;  // for sorting: not on the stack, which is a task's
  std::size_t reserved_;
};

template <class Sink>
void Calendar::give(std::uint32_t chunk, Sink to) {
  while (chunk != none) {
    const Chunk gone = chunks_[chunk];  // what is given may come back, and need one
    release(chunk);
    for (std::uint32_t i = 0; i < gone.filled; ++i) to(gone.entries[i]);
    chunk = gone.next;
  }
}

template <class Sink>
void Calendar::open(std::uint64_t time, unsigned width_log2, std::uint32_t buckets, Sink early) {
  const std::uint32_t all = detach_all();
  shift_ = width_log2;
  mask_ = (buckets < buckets_max ? buckets : buckets_max) - 1;
  cursor_ = (time >> shift_) + 1;
  horizon_ = cursor_ << shift_;
  move_limit();
  give(all, [&](const EventEntry& entry) {
    if (entry.key.due_ns() >= horizon_)
      insert(*entry.node, entry.key);
    else
      early(entry);
  });
}

template <class Sink>
void Calendar::close(Sink to) {
  give(detach_all(), to);
  horizon_ = closed;
}

}  // namespace waitpoint::kernel
