// SPDX-License-Identifier: BSD-3-Clause
// Event sets alone, for the limit: the cost of ordering events without switching tasks.
//
// Each task has one event. The order is exact: by time, then by insertion.
//
//   HeapSet       a heap with four children per node: best for few events
//   CalendarSet   days of about three events, as lists; a day is sorted when due. Events beyond the year are kept
//                 separately.
#pragma once

#include <cstdint>
#include <vector>

namespace waitpoint::bench {

struct SetEntry {
  std::int64_t time;
  std::uint32_t sequence;
  std::uint32_t task;
  bool before(const SetEntry& other) const {
    return time != other.time ? time < other.time
                              : static_cast<std::int32_t>(sequence - other.sequence) < 0;  // wraps around
  }
};

class HeapSet {
 public:
  HeapSet(std::uint32_t, std::int64_t) {}

  void insert(std::int64_t time, std::uint32_t task) {
    heap_.push_back({time, sequence_++, task});
    std::size_t at = heap_.size() - 1;
    const SetEntry entry = heap_[at];
    for (; at > 0 && entry.before(heap_[(at - 1) / 4]); at = (at - 1) / 4) heap_[at] = heap_[(at - 1) / 4];
    heap_[at] = entry;
  }
  SetEntry least() const { return heap_[0]; }
  /// Replaces the least.
  void move_least(std::int64_t time) {
    const SetEntry entry{time, sequence_++, heap_[0].task};
    const std::size_t size = heap_.size();
    std::size_t at = 0;
    for (std::size_t first = 1; first < size; first = 4 * at + 1) {
      const std::size_t end = first + 4 < size ? first + 4 : size;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < end; ++child)
        if (heap_[child].before(heap_[least])) least = child;
      if (entry.before(heap_[least])) break;
      heap_[at] = heap_[least];
      at = least;
    }
    heap_[at] = entry;
  }

 private:
  std::vector<SetEntry> heap_;
  std::uint32_t sequence_ = 0;
};

class CalendarSet {
 public:
  /// For `tasks` tasks with the given mean sleep.
  CalendarSet(std::uint32_t tasks, std::int64_t mean_ns) : next_(tasks), entries_(tasks) {
    while ((std::int64_t{1} << (shift_ + 1)) < 3 * mean_ns / tasks) ++shift_;
    std::size_t days = 16;
    while (days < tasks) days *= 2;
    days_.assign(days, none);
  }

  void insert(std::int64_t time, std::uint32_t task) { put({time, sequence_++, task}); }
  SetEntry least() {
    while (due_.empty()) turn_page();
    return due_.back();
  }
  void move_least(std::int64_t time) {
    const std::uint32_t task = due_.back().task;
    due_.pop_back();
    put({time, sequence_++, task});
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  void put(const SetEntry& entry) {
    const std::int64_t day = entry.time >> shift_;
    if (day <= today_) {
      sort_in(entry);
    } else if (day < today_ + static_cast<std::int64_t>(days_.size())) {
      std::uint32_t& first = days_[static_cast<std::size_t>(day) % days_.size()];
      entries_[entry.task] = entry;
      next_[entry.task] = first;
      first = entry.task;
    } else {
      later_.push_back(entry);
    }
  }
  // Today's events are sorted, the next one last.
  void sort_in(const SetEntry& entry) {
    std::size_t at = due_.size();
    due_.push_back(entry);
    for (; at > 0 && due_[at - 1].before(entry); --at) due_[at] = due_[at - 1];
    due_[at] = entry;
  }
  void turn_page() {
    ++today_;
    if (static_cast<std::size_t>(today_) % days_.size() == 0) {
      std::vector<SetEntry> later;
      later.swap(later_);
      for (const SetEntry& entry : later) put(entry);
    }
    std::uint32_t& first = days_[static_cast<std::size_t>(today_) % days_.size()];
    for (std::uint32_t task = first; task != none; task = next_[task]) sort_in(entries_[task]);
    first = none;
  }

  int shift_ = 0;  // from a time to its day
  std::int64_t today_ = -1;
  std::vector<std::uint32_t> days_;  // the first task of each day
  std::vector<std::uint32_t> next_;  // the next task of the same day, by task
  std::vector<SetEntry> entries_;    // by task
  std::vector<SetEntry> due_;
  std::vector<SetEntry> later_;
  std::uint32_t sequence_ = 0;
};

}  // namespace waitpoint::bench
