// SPDX-License-Identifier: BSD-3-Clause
// The later events of a large event list: buckets of equal spans of time, unsorted until they are due.
//
//              horizon                                       limit
//     time ------|-- bucket --|-- bucket --|-- ... --|-- bucket --|-------- far --------
//      run and heap                  the ring                      one more bucket
//
// The horizon advances by one bucket, the limit by half a ring at a time, with one scan of the far events.
// Inserting, removing and taking the next bucket cost the same for a thousand events and for a million (R. Brown 1988,
// the calendar queue; W. T. Tang et al. 2005, the ladder queue, for sorting only what is due).
//
// That cost is cache misses. A bucket is a chain of chunks, all full but the newest, and there are about as many
// buckets as events in a bucket: so an event is written next to the previous one of its bucket, whose line is in the
// cache, and a bucket is read sequentially. Entries are separate from the tasks' records, since each record would cost
// a page.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/kernel/event.hpp"

namespace waitpoint::kernel {

class Calendar {
 public:
  /// The address space of a calendar for `capacity` events.
  static constexpr std::size_t bytes(std::uint32_t capacity) {
    return chunks(capacity) * sizeof(Chunk) + heads_bytes + buckets_max / 8 + parts_max * sizeof(std::uint32_t);
  }
  /// For at most `capacity` events. Reserves address space; memory is committed as it is used.
  explicit Calendar(std::uint32_t capacity);
  ~Calendar();
  Calendar(const Calendar&) = delete;
  Calendar& operator=(const Calendar&) = delete;

  /// Accepts only events due at the horizon or later; none while closed.
  std::uint64_t horizon() const { return horizon_; }
  std::uint32_t size() const { return in_ring_ + in_far_; }
  std::uint32_t far_size() const { return in_far_; }
  unsigned width_log2() const { return shift_; }
  std::uint32_t buckets() const { return mask_ + 1; }
  bool is_open() const { return horizon_ != closed; }

  /// Sets the buckets' span to 2^width_log2 ns and their number, a power of two of at least 64, and the horizon to
  /// their first boundary after `time`. Returns the events before the horizon: early(entry).
  template <class Sink>
  void open(std::uint64_t time, unsigned width_log2, std::uint32_t buckets, Sink early);
  /// Returns all events: to(entry).
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

  /// Moves the events of the first non-empty bucket to `to`, sorted, and the horizon to the end of that bucket. Returns
  /// their number; 0 if the calendar is empty. Positions in the nodes, each in a page of its own, are not updated.
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
    std::uint32_t next;    // the next older chunk of the bucket; or the next in the free list or a detached chain
    std::uint32_t filled;  // number of entries; not maintained in a bucket's newest chunk
  };
  struct Bucket {
    std::uint32_t newest;  // chunk, or none
    std::uint32_t filled;  // number of its entries; 0 only without a chunk
  };
  static constexpr std::size_t heads_bytes = (std::size_t{buckets_max} + 1) * sizeof(Bucket) + 56;
  // Full chunks, and a partial one per bucket; while a calendar is reopened, per old and per new bucket.
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
  // Takes the chunks of a bucket and returns them as a chain, oldest first.
  std::uint32_t detach(std::uint32_t bucket);
  // The same for all buckets.
  std::uint32_t detach_all();
  // The events of detached chunks: to(entry).
  template <class Sink>
  void give(std::uint32_t chunk, Sink to);
  std::uint32_t copy_if_sorted(std::uint32_t chunk, EventEntry* to) const;
  std::uint32_t copy_sorted(std::uint32_t chunk, EventEntry* to);
  // The first bucket from `number` on that has events; the limit if there is none.
  std::uint64_t next_occupied(std::uint64_t number) const;
  void move_limit();
  void take_near_ones_out_of_far();

  std::uint64_t horizon_ = closed;
  std::uint64_t cursor_ = 0;     // the bucket that begins at the horizon, counted from the start of the run
  std::uint64_t limit_ = 0;      // a multiple of half the ring, between half a ring and a ring after the cursor
  std::uint64_t far_least_ = 0;  // no far event is in a bucket before this one
  std::uint32_t mask_ = 0;
  unsigned shift_ = 0;
  std::uint32_t in_ring_ = 0;
  std::uint32_t in_far_ = 0;
  std::uint32_t free_ = none;
  std::uint32_t opened_ = 0;
  Chunk* chunks_;
  Bucket* buckets_;  // the ring's, then the one of the far events
  std::uint64_t* occupied_;
  std::uint32_t* ends_;  // for sorting; not on the stack, since that is a task's
  std::size_t reserved_;
};

template <class Sink>
void Calendar::give(std::uint32_t chunk, Sink to) {
  while (chunk != none) {
    const Chunk gone = chunks_[chunk];  // a copy: to() may insert the entry again, into this chunk
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
