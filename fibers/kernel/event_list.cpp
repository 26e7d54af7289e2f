// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/event_list.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "fibers/kernel/fetch.hpp"

namespace waitpoint::kernel {
namespace {

EventEntry* reserve(std::size_t entries) {
  void* memory = mmap(nullptr, entries * sizeof(EventEntry), PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  WAITPOINT_CHECK(memory != MAP_FAILED, "no address space for the event list");
  return static_cast<EventEntry*>(memory);
}

// The heap's entries, then the run's: room for two runs, so that a bucket fits behind what is left of the one before.
std::size_t entries(std::uint32_t capacity) { return std::size_t{capacity} * 4 + EventHeap::margin + 1; }

// Buckets that hold one event or two each.
unsigned ideal_width_log2(std::uint64_t gap_ns) { return static_cast<unsigned>(std::bit_width(gap_ns)) + 2; }

}  // namespace

EventList::EventList(std::uint32_t capacity)
    : capacity_(capacity), memory_(reserve(entries(capacity))), heap_(memory_), calendar_(capacity) {
  run_ = memory_ + capacity + EventHeap::margin;
  run_[0].key = EventKey::never();
  run_bound_ = std::min(2 * capacity, run_bound_);
}

bool EventList::has_address_space(std::uint32_t capacity) {
  const std::size_t size = entries(capacity) * sizeof(EventEntry) + Calendar::bytes(capacity);
  void* memory = mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return false;
  munmap(memory, size);
  return true;
}

EventList::~EventList() { munmap(memory_, entries(capacity_) * sizeof(EventEntry)); }

void EventList::restart() {
  WAITPOINT_CHECK(size_ == 0, "a list with events is begun anew");
  if (calendar_.is_open()) close_calendar();
  empty_run();
  run_bound_ = std::min(2 * capacity_, 4 * run_length_min);
  calibration_period_ = until_upkeep_ = calibration_period_min;
  present_ns_ = calibrated_at_ns_ = 0;
  passed_ = 0;
}

void EventList::remove(EventNode& node) {
  WAITPOINT_CHECK(node.in_list(), "an event to remove is not in the list");
  switch (node.part()) {
    case EventNode::Part::heap: heap_.remove(node.index()); break;
    case EventNode::Part::run: remove_from_run(find_from(node.index(), node)); break;
    case EventNode::Part::calendar:
      if (!calendar_.was_taken(node)) {
        calendar_.remove(node);
        break;
      }
      remove_from_run(find_in_run(node));
      calendar_.release(node);
      break;
  }
  node.place = EventNode::absent;
  --size_;
  if (run_end_ - run_head_ < lookahead_) refill();
}

void EventList::remove_from_run(std::uint32_t index) {
  run_[index].node = nullptr;
  if (index == run_head_) pass_gaps();
}

std::uint32_t EventList::find_in_run(const EventNode& node) const {
  const EventEntry* entry =
      std::lower_bound(run_ + run_head_, run_ + run_end_, calendar_.key(node),
                       [](const EventEntry& entry, const EventKey& key) { return entry.key < key; });
  return find_from(static_cast<std::uint32_t>(entry - run_), node);
}

// A node knows where it was put; since then it may have been moved up, once by each that came before it near the end.
std::uint32_t EventList::find_from(std::uint32_t index, const EventNode& node) const {
  while (run_[index].node != &node) ++index;
  return index;
}

void EventList::put_elsewhere(EventNode& node, const EventKey& key) {
  if (key.due_ns() >= calendar_.horizon()) {
    calendar_.insert(node, key);
    if (run_end_ - run_head_ < lookahead_) refill();
  } else if (run_end_ >= run_bound_) {
    tidy_run();
    put(node, key);
  } else {
    heap_.insert({key, &node});
  }
}

// Entries that were passed, and gaps, are to be fewer than those that stay, so that this costs each of them little.
void EventList::tidy_run() {
  move_run_down();
  run_bound_ = std::min(2 * capacity_, 2 * run_end_ + 4 * run_length_min);
}

void EventList::pass_gaps() {
  while (run_head_ < run_end_ && run_[run_head_].node == nullptr) ++run_head_;
  if (run_head_ == run_end_) empty_run();
}

void EventList::move_run_down() {
  std::uint32_t end = 0;
  for (std::uint32_t i = run_head_; i < run_end_; ++i) {
    if (run_[i].node == nullptr) continue;
    run_[end] = run_[i];
    note_place_in_run(run_[end++]);
  }
  run_head_ = 0;
  run_end_ = end;
  run_[end].key = EventKey::never();
}

void EventList::refill() {
  if (size_ < few) return close_calendar();
  // What is left is little, and would wander through the memory.
  if (run_head_ >= run_length_min) move_run_down();
  const std::uint32_t known = run_end_;
  do {
    const std::uint32_t count = calendar_.take_next(run_ + run_end_);
    if (count == 0) break;
    run_end_ += count;
  } while (run_end_ - run_head_ < lookahead_ + batch);
  passed_ += run_end_ - known;
  run_[run_end_].key = EventKey::never();
  // Each is in a page of its own, which the processor has not seen for long. The looks for where the pages are take the
  // time of one only where they follow each other closely.
  for (std::uint32_t i = known; i < run_end_; ++i) fetch(run_[i].node);
  for (std::uint32_t i = known; i < run_end_; ++i) fetch(reinterpret_cast<const char*>(run_[i].node) + 64);
  calendar_.prepare_next(batch);
}

void EventList::keep_up() {
  if (run_end_ - run_head_ < lookahead_) refill();
  if (until_upkeep_ == 0) calibrate();
}

// Now and then: does the calendar fit the events?
void EventList::calibrate() {
  if (!calendar_.is_open()) passed_ += calibration_period_;
  calibration_period_ = size_ < calibration_period_min ? calibration_period_min : size_;
  until_upkeep_ = calibration_period_;
  if (present_ns_ <= calibrated_at_ns_) return;
  // Where nearly all are timeouts that do not come about, too little passes to measure by.
  if (size_ >= many && passed_ >= size_ / 8) open_calendar((present_ns_ - calibrated_at_ns_) / passed_);
  calibrated_at_ns_ = present_ns_;
  passed_ = 0;
}

void EventList::open_calendar(std::uint64_t gap_ns) {
  const unsigned width = ideal_width_log2(gap_ns);
  const std::uint32_t buckets = std::bit_ceil(size_) * 2;
  if (calendar_.is_open()) {
    const int wider = static_cast<int>(calendar_.width_log2()) - static_cast<int>(width);
    if (wider >= -1 && wider <= 1 && calendar_.buckets() >= buckets / 2 && calendar_.buckets() <= buckets * 2) return;
  }
  // All of the run stays ahead of the horizon.
  std::uint64_t bound_ns = present_ns_;
  if (run_head_ < run_end_ && run_[run_end_ - 1].key.due_ns() > bound_ns) bound_ns = run_[run_end_ - 1].key.due_ns();
  calendar_.open(bound_ns, width, buckets, [&](const EventEntry& early) { heap_.insert(early); });
  heap_.drain_from(calendar_.horizon(), [&](const EventEntry& late) { calendar_.insert(*late.node, late.key); });
  lookahead_ = lookahead;
  refill();
}

void EventList::close_calendar() {
  calendar_.close([&](const EventEntry& entry) { heap_.insert(entry); });
  lookahead_ = 0;
}

}  // namespace waitpoint::kernel
