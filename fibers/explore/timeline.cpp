// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/timeline.hpp"

#include <algorithm>
#include <ostream>

namespace waitpoint::exploration {
namespace {

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

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
