// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/event_list.hpp"

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "fibers/kernel/fetch.hpp"
#include "fibers/switch/reserved_pages.hpp"

namespace waitpoint::kernel {
namespace {

EventEntry* reserve(std::size_t entries) {
  void* const memory = reserve_pages(entries * sizeof(EventEntry));
  WAITPOINT_CHECK(memory != nullptr, "no address space for the event list");
  return static_cast<EventEntry*>(memory);
}

// The heap's entries, then the run's, with room for two full runs: a bucket must fit behind the remainder of the
// previous one.
std::size_t entries(std::uint32_t capacity) { return std::size_t{capacity} * 4 + EventHeap::margin + 1; }

// A power of two near the square root.
std::uint32_t root(std::uint32_t size) { return 1u << std::bit_width(size) / 2; }

// The span for which a bucket has as many events as there are buckets of near events: see calendar.hpp.
unsigned ideal_width_log2(std::uint64_t gap_ns, std::uint32_t near) {
  constexpr std::uint64_t longest_gap_ns = std::uint64_t{1} << 40;
  return static_cast<unsigned>(std::bit_width(std::min(gap_ns, longest_gap_ns) * root(near)));
}
// More buckets than that, so that the far events are seldom scanned.
std::uint32_t ideal_buckets(std::uint32_t size) { return 8 * root(size); }

}  // namespace

EventList::EventList(std::uint32_t capacity)
    : capacity_(capacity), memory_(reserve(entries(capacity))), heap_(memory_), calendar_(capacity) {
  run_ = memory_ + capacity + EventHeap::margin;
  empty_run();
  set_bound();
}

bool EventList::has_address_space(std::uint32_t capacity) {
  const std::size_t size = entries(capacity) * sizeof(EventEntry) + Calendar::bytes(capacity);
  void* const memory = reserve_pages(size);
  if (memory == nullptr) return false;
  release_pages(memory, size);
  return true;
}

EventList::~EventList() { release_pages(memory_, entries(capacity_) * sizeof(EventEntry)); }

void EventList::restart() {
  WAITPOINT_CHECK(size_ == 0, "a non-empty event list is restarted");
  if (calendar_.is_open()) close_calendar();
  empty_run();
  set_bound();
  calibration_period_ = until_upkeep_ = calibration_period_min;
  present_ns_ = calibrated_at_ns_ = 0;
  passed_ = 0;
}

void EventList::remove(EventNode& node) {
  WAITPOINT_CHECK(node.in_list(), "an event to remove is not in the list");
  switch (node.part()) {
    case EventNode::Part::heap: heap_.remove(node.index()); break;
    case EventNode::Part::run: remove_from_run(find_from(node.index(), node)); break;
    case EventNode::Part::calendar: calendar_.remove(node); break;
  }
  node.place = EventNode::absent;
  --size_;
  if (end_ < head_ + lookahead_) refill();
}

void EventList::remove_from_run(std::uint32_t index) {
  run_[index].node = nullptr;
  if (run_ + index == head_) pass_gaps();
}

// `index` is the position at insertion: later insertions before the node may have moved it towards the end.
std::uint32_t EventList::find_from(std::uint32_t index, const EventNode& node) const {
  while (run_[index].node != &node) ++index;
  return index;
}

void EventList::put_elsewhere(EventNode& node, EventKey key) {
  if (key.due_ns() >= calendar_.horizon()) {
    calendar_.insert(node, key);
    if (end_ < head_ + lookahead_) refill();
  } else if (end_ >= bound_) {
    tidy_run();
    put(node, key);
  } else {
    heap_.insert({key, &node});
  }
}

// The bound makes the taken and removed entries at least as many as the remaining ones: amortised constant cost.
void EventList::tidy_run() {
  move_run_down();
  set_bound();
}

void EventList::set_bound() { bound_ = run_ + std::min(2 * capacity_, 2 * index_of(*end_) + 4 * run_length_min); }

void EventList::pass_gaps() { skip_gaps(); }

void EventList::move_run_down() {
  EventEntry* end = run_;
  for (const EventEntry* entry = head_; entry < end_; ++entry) {
    if (entry->node == nullptr) continue;
    *end = *entry;
    note_place_in_run(*end++);
  }
  head_ = run_;
  end_ = end;
  end_->key = EventKey::never();
}

void EventList::refill() {
  if (size_ < few) return close_calendar();
  // The remainder is short; without the move the run would travel through memory.
  if (head_ >= run_ + run_length_min) move_run_down();
  EventEntry* const known = end_;
  do {
    const std::uint32_t count = calendar_.take_next(end_);
    if (count == 0) break;
    end_ += count;
  } while (end_ < head_ + lookahead_ + batch);
  passed_ += static_cast<std::uint32_t>(end_ - known);
  end_->key = EventKey::never();
  // Each node is in a page of its own that is not in the TLB; page walks overlap only if the accesses are close
  // together.
  for (const EventEntry* entry = known; entry < end_; ++entry) fetch(entry->node);
  for (const EventEntry* entry = known; entry < end_; ++entry) note_place_in_run(*entry);
}

void EventList::keep_up() {
  if (end_ < head_ + lookahead_) refill();
  if (until_upkeep_ == 0) calibrate();
}

// Periodically fits the calendar to the number and the distance of the events.
void EventList::calibrate() {
  if (!calendar_.is_open()) passed_ += calibration_period_;
  calibration_period_ = size_ < calibration_period_min ? calibration_period_min : size_;
  until_upkeep_ = calibration_period_;
  if (present_ns_ <= calibrated_at_ns_) return;
  // If nearly all events are cancelled timeouts, too few are taken for a measurement.
  if (size_ >= many && passed_ >= size_ / 8) open_calendar((present_ns_ - calibrated_at_ns_) / passed_);
  calibrated_at_ns_ = present_ns_;
  passed_ = 0;
}

void EventList::open_calendar(std::uint64_t gap_ns) {
  const unsigned width = ideal_width_log2(gap_ns, size_ - calendar_.far_size());
  const std::uint32_t buckets = ideal_buckets(size_);
  if (calendar_.is_open() && heap_.size() <= size_ / heap_share_max) {
    const int wider = static_cast<int>(calendar_.width_log2()) - static_cast<int>(width);
    if (wider >= -1 && wider <= 1 && calendar_.buckets() >= buckets / 2 && calendar_.buckets() <= buckets * 2) return;
  }
  // The run may reach beyond the new horizon; a horizon behind it would leave most events in the heap.
  for (const EventEntry* entry = head_; entry < end_; ++entry)
    if (entry->node != nullptr) heap_.insert(*entry);
  empty_run();
  calendar_.open(present_ns_, width, buckets, [&](const EventEntry& early) { heap_.insert(early); });
  heap_.drain_from(calendar_.horizon(), [&](const EventEntry& late) { calendar_.insert(*late.node, late.key); });
  lookahead_ = lookahead;
  refill();
}

void EventList::close_calendar() {
  calendar_.close([&](const EventEntry& entry) { heap_.insert(entry); });
  lookahead_ = 0;
}

}  // namespace waitpoint::kernel
