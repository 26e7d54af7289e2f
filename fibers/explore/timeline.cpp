// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/timeline.hpp"

#include <algorithm>
#include <ostream>

#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/sync/object_names.hpp"

namespace waitpoint::exploration {
namespace {

using kernel::Operation;

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

std::string title_of(const Task& task) {
  const std::string title = std::string(task.name) + "#" + std::to_string(task.number);
  return std::string_view(task.robot->name) == "environment" ? title : title + " of " + task.robot->name;
}

std::string about_to(const Task& task) {
  std::string text = title_of(task) + ", about to " + name(task.operation);
  if (task.at != nullptr) text += " " + sync::describe(*task.at);
  return text;
}

TimelineRecorder::TimelineRecorder(Timeline& timeline, const Explorer& explorer, Time from)
    : timeline_(timeline), explorer_(explorer), from_(from) {
  event = &TimelineRecorder::record;
}

std::uint32_t TimelineRecorder::number_of(const Task& task) {
  const auto [known, is_new] = numbers_.emplace(task.id, static_cast<std::uint32_t>(timeline_.tasks.size()));
  if (is_new) timeline_.tasks.push_back(title_of(task));
  return known->second;
}

void TimelineRecorder::record(kernel::Watch& watch, const kernel::EventRecord& record) {
  TimelineRecorder& self = static_cast<TimelineRecorder&>(watch);
  const std::vector<Decision>& decisions = self.explorer_.schedule().decisions;
  const bool is_switch =
      decisions.size() > self.decisions_ && decisions.back().is_switch() && decisions.back().choice == Choice::task;
  self.decisions_ = decisions.size();
  if (record.time < self.from_) return;
  std::vector<TimelineEvent>& events = self.timeline_.events;
  std::int64_t woken_by = -1;
  if (record.object != nullptr && record.operation == Operation::resume) {
    const auto last = self.last_release_.find(record.object->identity);
    if (last != self.last_release_.end()) woken_by = last->second;
  } else if (record.object != nullptr && record.operation != Operation::timeout) {
    self.last_release_[record.object->identity] = static_cast<std::int64_t>(events.size());
  }
  const std::uint32_t task = self.number_of(*record.task);
  events.push_back({record.time, task, record.operation, record.object != nullptr ? sync::describe(*record.object) : "",
                    woken_by, is_switch});
}

Timeline take_timeline(Body& body, const Schedule& schedule) {
  Timeline timeline;
  TimelineRecorder recording(timeline, body.explorer());
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  scheduler.set_watch(&recording);
  Fifo rest;
  (void)body.run(rest, {.prefix = schedule.decisions});
  scheduler.set_watch(nullptr);
  return timeline;
}

std::string to_text(const Timeline& timeline, std::size_t events_max) {
  std::size_t width = 0;
  for (const std::string& task : timeline.tasks) width = std::max(width, task.size());
  const std::size_t from = timeline.events.size() - std::min(timeline.events.size(), events_max);
  std::string text = from > 0 ? "  ... " + std::to_string(from) + " events before\n" : "";
  for (std::size_t i = from; i < timeline.events.size(); ++i) {
    const TimelineEvent& event = timeline.events[i];
    const std::string& task = timeline.tasks[event.task];
    text += "  " + to_string(event.time) + (event.is_switch ? " * " : "   ") + task;
    text += std::string(width - task.size() + 2, ' ') + name(event.operation);
    text += event.object.empty() ? "\n" : " " + event.object + "\n";
  }
  return text;
}

void write_trace(std::ostream& out, const Timeline& timeline) {
  // Microseconds, which is the format's unit; three digits behind the point are its nanoseconds.
  std::vector<std::string> stamps;
  std::int64_t last_ns = -1;
  for (const TimelineEvent& event : timeline.events) {
    last_ns = std::max(last_ns + 1, event.time.ns());
    std::string digits = std::to_string(last_ns % 1000);
    stamps.push_back(std::to_string(last_ns / 1000) + "." + std::string(3 - digits.size(), '0') + digits);
  }
  out << "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n";
  for (std::size_t i = 0; i < timeline.tasks.size(); ++i)
    out << "{\"ph\":\"M\",\"name\":\"thread_name\",\"pid\":1,\"tid\":" << i + 1
        << ",\"args\":{\"name\":" << quoted(timeline.tasks[i]) << "}},\n";
  for (std::size_t i = 0; i < timeline.events.size(); ++i) {
    const TimelineEvent& event = timeline.events[i];
    const std::string where = ",\"pid\":1,\"tid\":" + std::to_string(event.task + 1);
    const std::string title = name(event.operation) + (event.object.empty() ? "" : " " + event.object);
    out << "{\"ph\":\"X\",\"name\":" << quoted(title) << ",\"cat\":" << (event.is_switch ? "\"switch\"" : "\"event\"")
        << ",\"ts\":" << stamps[i] << ",\"dur\":0.001" << where << "},\n";
    if (event.woken_by < 0) continue;
    const auto from = static_cast<std::size_t>(event.woken_by);
    out << "{\"ph\":\"s\",\"name\":\"wakes\",\"cat\":\"wake\",\"id\":" << i << ",\"ts\":" << stamps[from]
        << ",\"pid\":1,\"tid\":" << timeline.events[from].task + 1 << "},\n";
    out << "{\"ph\":\"f\",\"bp\":\"e\",\"name\":\"wakes\",\"cat\":\"wake\",\"id\":" << i << ",\"ts\":" << stamps[i]
        << where << "},\n";
  }
  out << "{\"ph\":\"M\",\"name\":\"process_name\",\"pid\":1,\"args\":{\"name\":\"waitpoint\"}}\n]}\n";
}

}  // namespace waitpoint::exploration
