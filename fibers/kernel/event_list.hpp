// SPDX-License-Identifier: BSD-3-Clause
// The event list: every ready task has exactly one event in it, and the least event is next (the paper's Algorithm 1).
//
// The order is exact and total: by time, then by order = phase:4 | tie:60. Nodes are members of their tasks and timers
// and store their positions, so that a cancelled timeout is removed at once, not marked.
//
// The run is a sorted array of the next events. An event whose place is near the end of the run is inserted there: the
// usual case if events are few or of one instant. An event whose place is far before the end goes to a heap. When
// events become many, later ones go to a calendar, whose buckets are sorted into the run one after the other:
//
//      least of run and heap | ......... | horizon | ................ calendar ................
//
// The buckets' span follows from the mean distance of events in virtual time, measured periodically.
#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "fibers/kernel/calendar.hpp"
#include "fibers/kernel/event.hpp"
#include "fibers/kernel/event_heap.hpp"

namespace waitpoint::kernel {

class EventList {
 public:
  /// Reserves address space for `capacity` events, at most 2^29; memory is committed as it is used.
  explicit EventList(std::uint32_t capacity);
  ~EventList();
  /// True if there is enough address space for a full list of this capacity.
  static bool has_address_space(std::uint32_t capacity);
  EventList(const EventList&) = delete;
  EventList& operator=(const EventList&) = delete;

  /// Reinitialises the list, which must be empty.
  void restart();

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }
  /// The least entry; its key is EventKey::never() if the list is empty.
  const EventEntry& least() const { return heap_.least().key < head_->key ? heap_.least() : *head_; }
  /// True if the least event is due at `time` or before.
  bool is_due(Time time) const { return head_->key.time <= time || heap_.least().key.time <= time; }
  /// True if events are so many that the calendar is in use.
  bool is_large() const { return lookahead_ != 0; }
  /// The node that is `ahead` events after the first of the run, for prefetching; null if the run is shorter.
  const EventNode* coming(std::uint32_t ahead) const { return head_ + ahead < end_ ? head_[ahead].node : nullptr; }

  /// `node` must not be in the list.
  [[gnu::always_inline]] void insert(EventNode& node, EventKey key) {
    check_insertion(node);
    WAITPOINT_CHECK(size_ < capacity_,
                    "more events than a run may have pending: tasks, timers, and messages under way");
    ++size_;
    put(node, key);
  }
  /// `node` must be in the list.
  void remove(EventNode& node);
  /// remove() where no other work is needed, the usual case with few events; otherwise false, with nothing changed.
  bool try_remove_fast(EventNode& node) {
    EventEntry& entry = run_[node.index()];
    if (is_large() || node.part() != EventNode::Part::run || entry.node != &node) return false;
    entry.node = nullptr;
    node.place = EventNode::absent;
    --size_;
    if (&entry == head_) {
      ++head_;
      skip_gaps();
    }
    return true;
  }
  /// insert() if the place is near the end of the run; otherwise false, with nothing changed.
  bool try_insert_fast(EventNode& node, EventKey key) {
    if (size_ >= capacity_ || node.in_list() || !belongs_near_end(key)) return false;
    ++size_;
    put_near_end(node, key);
    return true;
  }
  /// Takes out the least event; the list must not be empty.
  EventNode& pop() {
    WAITPOINT_CHECK(size_ > 0, "the event list is empty");
    return take(least());
  }
  /// pop() and insert(node, key) in one step; `least` must be least().
  [[gnu::always_inline]] EventNode& exchange(const EventEntry& least, EventNode& node, EventKey key) {
    check_insertion(node);
    EventNode& taken = take(least);
    ++size_;
    put(node, key);
    return taken;
  }
  /// pop() if the least event is due before `until`; otherwise null.
  EventNode* pop_before(Time until) {
    const EventEntry& first = least();
    return first.key.time < until ? &take(first) : nullptr;
  }
  /// The present instant: the time of the event taken last, or of a later advance().
  Time present() const { return Time::from_ns(static_cast<std::int64_t>(present_ns_)); }
  /// Advances the present instant to `time` without taking an event; no event may be due before.
  void advance(Time time) { present_ns_ = static_cast<std::uint64_t>(time.ns()); }

 private:
  static constexpr std::uint32_t few = 12;            // below this number of events the calendar is closed
  static constexpr std::uint32_t many = 32;           // from this number on it is opened
  static constexpr std::uint32_t lookahead = 8;       // minimum length of the run while the calendar is open
  static constexpr std::uint32_t batch = 8;           // number of events beyond that which a refill adds
  static constexpr std::uint32_t heap_share_max = 4;  // with more than a quarter in the heap, the horizon is too far
  static constexpr std::uint32_t reach = 12;          // greatest number of entries that an insertion into the run moves
  static constexpr std::uint32_t run_length_min = 64;  // the run is moved down after so many entries were taken
  static constexpr std::uint32_t calibration_period_min = 512;

  static void check_insertion(const EventNode& node) {
    WAITPOINT_CHECK(!node.in_list(), "an event is put into the list twice");
  }
  // Inserts the event into the run if its place is near the end; otherwise into the heap or the calendar.
  [[gnu::always_inline]] void put(EventNode& node, EventKey key) {
    if (__builtin_expect(!belongs_near_end(key), 0)) return put_elsewhere(node, key);
    put_near_end(node, key);
  }
  [[gnu::always_inline]] bool belongs_near_end(const EventKey& key) const {
    const bool is_far = end_ > head_ + reach && key < end_[-std::ptrdiff_t{reach}].key;
    return !is_far && key.due_ns() < calendar_.horizon() && end_ < bound_;
  }
  [[gnu::always_inline]] void put_near_end(EventNode& node, EventKey key) {
    EventEntry* at = end_;
    at[1].key = EventKey::never();
    // The positions of moved entries are not updated: see find_from().
    for (; at != head_ && key < at[-1].key; --at) *at = at[-1];
    *at = {key, &node};
    note_place_in_run(*at);
    ++end_;
  }
  void note_place_in_run(const EventEntry& entry) { entry.node->place = EventNode::in_run(index_of(entry)); }
  std::uint32_t index_of(const EventEntry& entry) const { return static_cast<std::uint32_t>(&entry - run_); }
  [[gnu::noinline]] void put_elsewhere(EventNode& node, EventKey key);
  [[gnu::always_inline]] EventNode& take(const EventEntry& least) {
    if (__builtin_expect(&least != head_, 0)) return take_from_heap();
    EventNode* node = least.node;
    present_ns_ = least.key.due_ns();
    ++head_;
    return taken(*node);
  }
  [[gnu::noinline]] EventNode& take_from_heap() {
    EventNode& node = *heap_.least().node;
    present_ns_ = heap_.least().key.due_ns();
    heap_.remove(0);
    --size_;
    node.place = EventNode::absent;
    if (--until_upkeep_ == 0) keep_up();
    return node;
  }
  // Completes the removal of the run's head.
  [[gnu::always_inline]] EventNode& taken(EventNode& node) {
    --size_;
    node.place = EventNode::absent;
    if (__builtin_expect(head_->node == nullptr, 0)) pass_gaps();  // at the end of the run the node is arbitrary
    if (__builtin_expect(--until_upkeep_ == 0 || end_ < head_ + lookahead_, 0)) keep_up();
    return node;
  }
  void empty_run() {
    head_ = end_ = run_;
    end_->key = EventKey::never();
  }
  // Restores the invariant that the head of the run is not a removed entry.
  void skip_gaps() {
    while (head_ < end_ && head_->node == nullptr) ++head_;
  }
  [[gnu::noinline]] void pass_gaps();
  void move_run_down();
  void set_bound();
  void tidy_run();
  void remove_from_run(std::uint32_t index);
  std::uint32_t find_from(std::uint32_t index, const EventNode& node) const;
  void refill();
  void keep_up();
  void calibrate();
  void open_calendar(std::uint64_t gap_ns);
  void close_calendar();

  std::uint32_t capacity_;
  std::uint32_t size_ = 0;
  EventEntry* memory_;
  EventHeap heap_;
  EventEntry* run_;  // ascending from head to end; the entry at the end has the key never()
  EventEntry* head_;
  EventEntry* end_;
  EventEntry* bound_;                                          // the run is compacted before its end exceeds this
  std::uint32_t lookahead_ = 0;                                // minimum length of the run; 0 without a calendar
  std::uint32_t calibration_period_ = calibration_period_min;  // in events taken
  std::uint32_t until_upkeep_ = calibration_period_min;
  std::uint64_t present_ns_ = 0;
  std::uint64_t calibrated_at_ns_ = 0;
  std::uint32_t passed_ = 0;  // events since then: all, or while the calendar is open, those taken from it
  Calendar calendar_;
};

}  // namespace waitpoint::kernel
