// SPDX-License-Identifier: BSD-3-Clause
// A four-ary heap of events, with the keys by value beside the nodes' addresses:
//
//   entries_:  [0: least] [1][2][3][4] [5..8: children of 1] [9..12: children of 2] ...
//
// The fastest event list for up to about a hundred events: a handful of cache lines. The least of four children is
// found without a branch; for that, the entries after the last one have the key never().
#pragma once

#include <cstdint>

#include "fibers/kernel/event.hpp"

namespace waitpoint::kernel {

class EventHeap {
 public:
  /// The number of entries that the memory must have beyond the capacity.
  static constexpr std::uint32_t margin = 8;

  /// `entries` is zeroed memory for the capacity and the margin.
  explicit EventHeap(EventEntry* entries) : entries_(entries) { bound(0); }

  std::uint32_t size() const { return size_; }
  /// The least entry; its key is never() if the heap is empty.
  const EventEntry& least() const { return entries_[0]; }

  void insert(const EventEntry& entry) {
    const std::uint32_t at = size_++;
    if (size_ > bounded_) bound(size_);
    sift_up(at, entry);
  }

  /// Takes out the entry at `at`; its node's position is not updated.
  void remove(std::uint32_t at) {
    const EventEntry last = entries_[--size_];
    entries_[size_].key = EventKey::never();
    if (at == size_) return;
    if (at > 0 && last.key < entries_[(at - 1) / 4].key)
      sift_up(at, last);
    else
      sift_down(at, last);
  }

  /// Takes out all entries due at `time` or later, in any order: to(entry).
  template <class Sink>
  void drain_from(std::uint64_t time, Sink to) {
    const std::uint32_t count = size_;
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (entries_[i].key.due_ns() < time)
        entries_[kept++] = entries_[i];
      else
        to(entries_[i]);
    }
    for (std::uint32_t i = kept; i < count; ++i) entries_[i].key = EventKey::never();
    // Rebuild the heap: insert the remaining entries one by one.
    for (size_ = 0; size_ < kept;) {
      const EventEntry entry = entries_[size_];
      sift_up(size_++, entry);
    }
  }

 private:
  void place(std::uint32_t at, const EventEntry& entry) {
    entries_[at] = entry;
    entry.node->place = EventNode::in_heap(at);
  }

  // Initialises the entries after the last one that sift_down() reads.
  void bound(std::uint32_t size) {
    bounded_ = size + 3;
    for (std::uint32_t i = size; i < size + margin; ++i) entries_[i].key = EventKey::never();
  }

  void sift_up(std::uint32_t at, const EventEntry& entry) {
    while (at > 0) {
      const std::uint32_t parent = (at - 1) / 4;
      if (!(entry.key < entries_[parent].key)) break;
      place(at, entries_[parent]);
      at = parent;
    }
    place(at, entry);
  }

  void sift_down(std::uint32_t at, const EventEntry& entry) {
    for (;;) {
      const std::uint32_t first = 4 * at + 1;
      if (first >= size_) break;
      const EventEntry* children = entries_ + first;
      const std::uint32_t left = children[1].key < children[0].key;
      const std::uint32_t right = 2 + (children[3].key < children[2].key);
      const std::uint32_t least = children[right].key < children[left].key ? right : left;
      if (!(children[least].key < entry.key)) break;
      place(at, children[least]);
      at = first + least;
    }
    place(at, entry);
  }

  EventEntry* entries_;
  std::uint32_t size_ = 0;
  std::uint32_t bounded_ = 0;  // entries from size to here and the margin have the key never()
};

}  // namespace waitpoint::kernel
