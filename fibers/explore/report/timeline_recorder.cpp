// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/timeline_recorder.hpp"

#include "fibers/explore/report/choice_text.hpp"
#include "fibers/sync/report/object_names.hpp"

namespace waitpoint::exploration {

using kernel::Operation;

TimelineRecorder::TimelineRecorder(Timeline& timeline, const Explorer* explorer, Time from)
    : timeline_(timeline), explorer_(explorer), from_(from) {
  event = &TimelineRecorder::record;
}

std::uint32_t TimelineRecorder::number_of(const Task& task) {
  const auto [known, is_new] = numbers_.emplace(task.id, static_cast<std::uint32_t>(timeline_.tasks.size()));
  if (is_new) timeline_.tasks.push_back({title_of(task), process_, task.number, task.name, task.robot->name});
  return known->second;
}

std::int32_t TimelineRecorder::number_of(const kernel::Object& object) {
  const auto [known, is_new] = objects_.emplace(object.identity, static_cast<std::int32_t>(timeline_.objects.size()));
  if (is_new)
    timeline_.objects.push_back({sync::describe(object), object.kind, object.label,
                                 object.robot != nullptr ? object.robot->name : "", object.number});
  if (object.kind == kernel::memory_kind) name_again(static_cast<const kernel::MemoryWord&>(object), known->second);
  return known->second;
}

// Accesses that begin elsewhere in the word are to other variables.
void TimelineRecorder::name_again(const kernel::MemoryWord& memory, std::int32_t number) {
  std::uint8_t& starts = starts_[number];
  if (starts != memory.starts) timeline_.objects[static_cast<std::size_t>(number)].title = sync::describe(memory);
  starts = memory.starts;
}

void TimelineRecorder::begin_process(const TimelineProcess& process) {
  process_ = static_cast<std::uint32_t>(timeline_.processes.size());
  timeline_.processes.push_back(process);
}

void TimelineRecorder::pause() {
  if (last_ == nullptr) return;
  TimelineEvent& last = timeline_.events[last_event_];
  if (last.operation != Operation::end && last_->state == kernel::TaskState::blocked)
    last.waits_for = number_of(*last_->blocked_on);
}

// True if the event now executing, or its process, was chosen over the default: call it once per event.
bool TimelineRecorder::is_switch(const Explorer& explorer) {
  const std::vector<Decision>& decisions = explorer.schedule().decisions;
  bool is_one = false;
  for (std::size_t i = timeline_.decisions; i < decisions.size(); ++i)
    if (decisions[i].choice == Choice::task || decisions[i].choice == Choice::process)
      is_one = decisions[i].is_switch() || (is_one && decisions[i - 1].choice == Choice::process);
  timeline_.decisions = decisions.size();
  return is_one;
}

// After its event a task either waits, or is ready for the next: another task's event shows which. If none intervened,
// its next event shows that it had waited.
void TimelineRecorder::note_wait(const kernel::EventRecord& record) {
  if (last_ == nullptr) return;
  TimelineEvent& last = timeline_.events[last_event_];
  if (last.operation == Operation::end) return;
  if (record.task != last_) {
    pause();
  } else if (record.object != nullptr &&
             (record.operation == Operation::resume || record.operation == Operation::timeout)) {
    last.waits_for = number_of(*record.object);
  }
}

void TimelineRecorder::record(kernel::Watch& watch, const kernel::EventRecord& record) {
  TimelineRecorder& self = static_cast<TimelineRecorder&>(watch);
  const bool is_switch = self.explorer_ != nullptr && self.is_switch(*self.explorer_);
  if (record.time < self.from_) {
    ++self.timeline_.events_before;
    return;
  }
  std::vector<TimelineEvent>& events = self.timeline_.events;
  self.note_wait(record);
  self.last_ = record.task;
  self.last_event_ = events.size();
  std::int64_t woken_by = -1;
  if (record.object != nullptr && record.operation == Operation::resume) {
    const auto last = self.last_release_.find(record.object->identity);
    if (last != self.last_release_.end()) woken_by = last->second;
  } else if (record.object != nullptr && record.operation != Operation::timeout) {
    self.last_release_[record.object->identity] = static_cast<std::int64_t>(events.size());
  }
  const std::uint32_t task = self.number_of(*record.task);
  EventOf which = event_of(*record.task);
  --which.sequence;  // includes this one already
  const std::int32_t object = record.object != nullptr ? self.number_of(*record.object) : -1;
  events.push_back({record.time, task, record.operation, object, -1, woken_by, is_switch, which});
}

}  // namespace waitpoint::exploration
