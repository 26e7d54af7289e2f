// SPDX-License-Identifier: BSD-3-Clause
// The events of a run after some decision, for comparing two runs that are the same up to there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/kernel/watch.hpp"

namespace waitpoint::exploration {

struct DoneEvent {
  EventOf event;
  kernel::Operation operation;
  std::uint64_t object;  ///< its identity, valid within one run; 0: none, as of calls
  kernel::EventFootprint footprint{};
};

/// Records events, as a scheduler's watch.
class EventLog final : public kernel::Watch {
 public:
  /// Records the events after decision `from` of `explorer`; at most events_max.
  EventLog(std::vector<DoneEvent>& events, const Explorer& explorer, std::size_t from)
      : events_(events), explorer_(explorer), from_(from) {
    event = &EventLog::add;
  }

 private:
  static constexpr std::size_t events_max = 1'000'000;

  static void add(kernel::Watch& watch, const kernel::EventRecord& record) {
    EventLog& self = static_cast<EventLog&>(watch);
    if (self.explorer_.schedule().decisions.size() <= self.from_ || self.events_.size() == events_max) return;
    EventOf which = event_of(*record.task);
    --which.sequence;  // includes this one already
    const bool is_at_object = record.object != nullptr && record.operation != kernel::Operation::call;
    self.events_.push_back(
        {which, record.operation, is_at_object ? record.object->identity : 0, record.task->footprint});
  }

  std::vector<DoneEvent>& events_;
  const Explorer& explorer_;
  std::size_t from_;
};

}  // namespace waitpoint::exploration
