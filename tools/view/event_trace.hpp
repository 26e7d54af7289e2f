// SPDX-License-Identifier: BSD-3-Clause
// The events of a part of a run in columns, for the timeline of a viewer: time, task, operation and object of each.
//
// It is a watch of the run, and passes events on to the one before it. Some 15 bytes an event.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "fibers/kernel/task.hpp"
#include "fibers/kernel/watch.hpp"

namespace waitpoint::tools::view {

class EventTrace : private kernel::Watch {
 public:
  /// Takes in at most `most` events, from now on. The scheduler must outlive this.
  EventTrace(kernel::Scheduler& scheduler, std::size_t most);
  ~EventTrace();
  EventTrace(const EventTrace&) = delete;
  EventTrace& operator=(const EventTrace&) = delete;

  /// False if there were more events: those that it has are the first.
  bool is_complete() const { return is_complete_; }
  std::size_t size() const { return times_.size(); }
  /// {"kind":"events","from":...,"to":...,...} of the events from `from` to before `to`.
  std::string text(Time from, Time to) const;

 private:
  static void see(kernel::Watch& watch, const kernel::EventRecord& record);
  std::uint32_t number_of(const kernel::Task& task);
  std::int32_t number_of(const kernel::Object& object);

  kernel::Scheduler& scheduler_;
  kernel::Watch* before_;
  std::size_t most_;
  std::uint64_t first_;  // the number of the first event, from 1
  bool is_complete_ = true;
  std::vector<std::int64_t> times_;
  std::vector<std::uint32_t> tasks_;  // indices into task_texts_
  std::vector<std::uint8_t> operations_;
  std::vector<std::int32_t> objects_;                               // indices into object_texts_; -1: none
  std::unordered_map<std::uint64_t, std::uint32_t> task_numbers_;   // by id
  std::unordered_map<std::uint64_t, std::int32_t> object_numbers_;  // by identity
  std::vector<std::string> task_texts_, object_texts_;              // as JSON
};

}  // namespace waitpoint::tools::view
