// SPDX-License-Identifier: BSD-3-Clause
// The event list: every task that can run has exactly one event in it, and the least one is next (the paper's Algorithm
// 1).
//
// The order is exact and total: by time, then by order = phase:4 | tie:60. Nodes live in their tasks and timers and
// know their place, so that a timeout that did not happen is removed truly.
//
// The structure is a heap with four children a node, its entries by value beside the nodes' addresses:
//
//   entries_:  [0: least] [1][2][3][4] [5..8: children of 1] [9..12: children of 2] ...
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::kernel {

/// At one instant, what runs before what.
enum class Phase : std::uint8_t { deliveries = 0, world = 1, tasks = 2 };

inline constexpr std::uint64_t tie_mask = (std::uint64_t{1} << 60) - 1;

constexpr std::uint64_t make_order(Phase phase, std::uint64_t tie) {
  return static_cast<std::uint64_t>(phase) << 60 | (tie & tie_mask);
}

/// When an event is due, and its place among those due then.
struct EventKey {
  Time time;
  std::uint64_t order = 0;

  friend constexpr bool operator<(const EventKey& a, const EventKey& b) {
    return a.time < b.time || (a.time == b.time && a.order < b.order);
  }
};

struct EventNode {
  static constexpr std::uint32_t absent = 0xFFFFFFFF;
  std::uint32_t place = absent;  ///< in the heap
  /// What a timer or a delivery does when due; null for a task, which is switched to. Must not block.
  void (*fire)(EventNode&) = nullptr;

  bool in_list() const { return place != absent; }
};

class EventList {
 public:
  struct Entry {
    EventKey key;
    EventNode* node;
  };

  /// Room for `capacity` events is reserved, and committed only as it is used.
  explicit EventList(std::uint32_t capacity);
  ~EventList();
  EventList(const EventList&) = delete;
  EventList& operator=(const EventList&) = delete;

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }
  const Entry& least() const { return entries_[0]; }

  /// `node` must not be in the list.
  void insert(EventNode& node, EventKey key);
  /// `node` must be in the list.
  void remove(EventNode& node);
  /// The list must not be empty.
  EventNode& pop();
  /// Takes the least event out and puts `node` in, which must not be there: one pass instead of two.
  EventNode& pop_and_insert(EventNode& node, EventKey key);

 private:
  void place(std::uint32_t at, const Entry& entry) {
    entries_[at] = entry;
    entry.node->place = at;
  }
  void sift_up(std::uint32_t at, const Entry& entry);
  void sift_down(std::uint32_t at, const Entry& entry);

  Entry* entries_;
  std::uint32_t size_ = 0;
  std::uint32_t capacity_;
};

}  // namespace waitpoint::kernel
