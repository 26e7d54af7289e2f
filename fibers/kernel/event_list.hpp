// SPDX-License-Identifier: BSD-3-Clause
// The event list: every task that can run has exactly one event in it, and the least one is next (the paper's Algorithm
// 1).
//
// The order is exact and total: by time, then by order = phase:4 | tie:60. Nodes live in their tasks and timers and
// know their place, so that a timeout that did not happen is removed truly.
//
// An event that comes near the end of those that are in their order, the run, is put there, as most are where events
// are few or of one instant; one that comes far before it, into a heap. When events become many, those that are not due
// soon go to a calendar, whose buckets come back sorted, one after the other, into the run:
//
//      least of run and heap | ......... | horizon | ................ calendar ................
//
// How long a bucket's span is follows from how fast virtual time goes over the events, measured now and then.
#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "fibers/kernel/calendar.hpp"
#include "fibers/kernel/event.hpp"
#include "fibers/kernel/event_heap.hpp"

namespace waitpoint::kernel {

class EventList {
 public:
  /// Room for `capacity` events, at most 2^29, is reserved, and committed only as it is used.
  explicit EventList(std::uint32_t capacity);
  ~EventList();
  /// Whether there is the address space for a list of this capacity, whatever is put into it.
  static bool has_address_space(std::uint32_t capacity);
  EventList(const EventList&) = delete;
  EventList& operator=(const EventList&) = delete;

  /// As new; it must be empty.
  void restart();

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }
  /// The least entry; its key reads as never due if the list is empty.
  const EventEntry& least() const { return heap_.least().key < head_->key ? heap_.least() : *head_; }
  /// Whether the least event is due at `time` or before.
  bool is_due(Time time) const { return head_->key.time <= time || heap_.least().key.time <= time; }
  /// Whether the events are so many that they are in a calendar.
  bool is_large() const { return lookahead_ != 0; }
  /// The node that is `ahead` events behind the least one of the run, if it is known already: to make it ready early.
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
  /// The same where nothing else is to be done for it, as mostly with few events; else false, with nothing done.
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
  /// As insert(), where its place is near the end of the run; else false, with nothing done.
  bool try_insert_fast(EventNode& node, EventKey key) {
    if (size_ >= capacity_ || node.in_list() || !belongs_near_end(key)) return false;
    ++size_;
    put_near_end(node, key);
    return true;
  }
  /// The list must not be empty.
  EventNode& pop() {
    WAITPOINT_CHECK(size_ > 0, "the event list is empty");
    return take(least());
  }
  /// As pop() and insert(node, key), where `least` is least().
  [[gnu::always_inline]] EventNode& exchange(const EventEntry& least, EventNode& node, EventKey key) {
    check_insertion(node);
    EventNode& taken = take(least);
    ++size_;
    put(node, key);
    return taken;
  }
  /// As pop(), unless the least event is due at `until` or later, or there is none: null then.
  EventNode* pop_before(Time until) {
    const EventEntry& first = least();
    return first.key.time < until ? &take(first) : nullptr;
  }
  /// The present instant: that of the event that was taken last, or to which advance() came.
  Time present() const { return Time::from_ns(static_cast<std::int64_t>(present_ns_)); }
  /// Time has come to `time` without an event out of the list; none in it is due before.
  void advance(Time time) { present_ns_ = static_cast<std::uint64_t>(time.ns()); }

 private:
  static constexpr std::uint32_t few = 12;            // events below which a calendar is given up
  static constexpr std::uint32_t many = 32;           // from which on one is taken
  static constexpr std::uint32_t lookahead = 8;       // where there is a calendar, events that are known ahead at least
  static constexpr std::uint32_t batch = 8;           // and how many more are made known at once then
  static constexpr std::uint32_t heap_share_max = 4;  // a quarter of the events: there the horizon is too far away
  static constexpr std::uint32_t reach = 12;          // entries of the run that an event may come before
  static constexpr std::uint32_t run_length_min = 64;  // the run begins anew when so much was passed
  static constexpr std::uint32_t calibration_period_min = 512;

  static void check_insertion(const EventNode& node) {
    WAITPOINT_CHECK(!node.in_list(), "an event is put into the list twice");
  }
  // Into its place in the run, if that is near its end; else to the others.
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
    // Those that are moved up are not told: see find_from().
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
  // What is left to do when the run's head was taken.
  [[gnu::always_inline]] EventNode& taken(EventNode& node) {
    --size_;
    node.place = EventNode::absent;
    if (__builtin_expect(head_->node == nullptr, 0)) pass_gaps();  // behind the end it may be anything
    if (__builtin_expect(--until_upkeep_ == 0 || end_ < head_ + lookahead_, 0)) keep_up();
    return node;
  }
  void empty_run() {
    head_ = end_ = run_;
    end_->key = EventKey::never();
  }
  // The head of the run is an event that was not removed; an empty run begins at the beginning.
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
  EventEntry* run_;  // from head to end in ascending order, and behind it an entry that is never due
  EventEntry* head_;
  EventEntry* end_;
  EventEntry* bound_;                                          // the run is tidied up before it ends beyond
  std::uint32_t lookahead_ = 0;                                // the run is kept so long, while there is a calendar
  std::uint32_t calibration_period_ = calibration_period_min;  // in events taken
  std::uint32_t until_upkeep_ = calibration_period_min;
  std::uint64_t present_ns_ = 0;
  std::uint64_t calibrated_at_ns_ = 0;
  std::uint32_t passed_ = 0;  // events since then: all, or while there is a calendar, those that came from there
  Calendar calendar_;
};

}  // namespace waitpoint::kernel
