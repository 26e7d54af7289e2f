// SPDX-License-Identifier: BSD-3-Clause
// Records the events of each task in a run.
#pragma once

#include <map>

#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/kernel/access.hpp"
#include "fibers/kernel/watch.hpp"

namespace waitpoint::exploration {

/// The events of one run from `from` on, as its scheduler's watch. Several processes of one simulation have each its
/// own, for the same timeline.
class TimelineRecorder : public kernel::Watch {
 public:
  /// Without an explorer no event is a switch; it must outlive the recorder.
  TimelineRecorder(Timeline& timeline, const Explorer* explorer, Time from = Time());

  /// The events from now on are of this process, whose tasks have had none.
  void begin_process(const TimelineProcess& process);
  /// Before another process's events: notes what the task of the last event waits for.
  void pause();

 private:
  static void record(kernel::Watch& watch, const kernel::EventRecord& record);
  std::uint32_t number_of(const Task& task);
  std::int32_t number_of(const kernel::Object& object);
  void name_again(const kernel::MemoryWord& memory, std::int32_t number);
  bool is_switch(const Explorer& explorer);
  void note_wait(const kernel::EventRecord& record);

  Timeline& timeline_;
  const Explorer* explorer_;
  Time from_;
  std::map<std::uint64_t, std::uint32_t> numbers_;      // by task id
  std::map<std::uint64_t, std::int32_t> objects_;       // by identity
  std::map<std::int32_t, std::uint8_t> starts_;         // of memory: kernel::MemoryWord::starts
  std::map<std::uint64_t, std::int64_t> last_release_;  // by object id: the last event that may have woken another task
  std::uint32_t process_ = 0;
  const Task* last_ = nullptr;  // the task of the last recorded event
  std::size_t last_event_ = 0;  // its index
};

}  // namespace waitpoint::exploration
