// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/timeline.hpp"

#include <algorithm>
#include <ostream>

#include "fibers/explore/report/json_text.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::size_t repeated_max = 8;   // longest sequence of lines checked for repetition
constexpr std::size_t repeats_shown = 3;  // repetitions up to this number are printed in full

std::string line_of(const Timeline& timeline, const TimelineEvent& event, std::size_t width) {
  const std::string& task = timeline.tasks[event.task].title;
  std::string line = "  " + to_string(event.time) + (event.is_switch ? " * " : "   ") + task;
  return line + std::string(width - task.size() + 2, ' ') + timeline.words(event);
}

// The number of further repetitions of the `count` lines from `from` on.
std::size_t repeats(const std::vector<std::string>& lines, std::size_t from, std::size_t count) {
  std::size_t again = from + count;
  while (again < lines.size() && lines[again] == lines[again - count]) ++again;
  return (again - from - count) / count;
}

// `count` lines once, followed by the number of repetitions.
std::vector<std::string> with_repeats_told(const std::vector<std::string>& lines, std::size_t count) {
  std::vector<std::string> told;
  for (std::size_t i = 0; i < lines.size();) {
    const std::size_t more = repeats(lines, i, count);
    if (more * count <= repeats_shown) {
      told.push_back(lines[i++]);
      continue;
    }
    for (std::size_t k = 0; k < count; ++k) told.push_back(lines[i + k]);
    told.push_back("      ... " + (count == 1 ? std::string("repeated") : std::to_string(count) + " lines repeated") +
                   " " + std::to_string(more) + (more == 1 ? " time" : " times"));
    i += count * (more + 1);
  }
  return told;
}

// Collapses the polling loops of tasks, innermost first, so that repetitions within repetitions are counted.
std::vector<std::string> with_repeats_told(std::vector<std::string> lines) {
  for (std::size_t count = 1; count <= repeated_max; ++count) {
    std::vector<std::string> told = with_repeats_told(lines, count);
    if (told.size() < lines.size()) count = 0;
    lines = std::move(told);
  }
  return lines;
}

// The format's unit, microseconds, with three decimals for nanoseconds.
std::string microseconds(std::int64_t ns) {
  const std::string digits = std::to_string(ns % 1000);
  return std::to_string(ns / 1000) + "." + std::string(3 - digits.size(), '0') + digits;
}

const TimelineProcess of_simulation{1, "waitpoint"};

// ",\"pid\":1,\"tid\":2" for a task.
std::string place_of(const Timeline& timeline, std::uint32_t task) {
  const TimelineProcess& process =
      timeline.processes.empty() ? of_simulation : timeline.processes[timeline.tasks[task].process];
  return ",\"pid\":" + std::to_string(process.id) + ",\"tid\":" + std::to_string(task + 1);
}

void name_rows(std::ostream& out, const Timeline& timeline) {
  const auto row = [&out](const char* kind, const std::string& place, const std::string& name) {
    out << "{\"ph\":\"M\",\"name\":\"" << kind << "\"" << place << ",\"args\":{\"name\":" << json_text(name) << "}}";
  };
  for (std::uint32_t i = 0; i < timeline.tasks.size(); ++i) {
    row("thread_name", place_of(timeline, i), timeline.tasks[i].title);
    out << ",\n";
  }
  const std::vector<TimelineProcess> one = {of_simulation};
  const std::vector<TimelineProcess>& processes = timeline.processes.empty() ? one : timeline.processes;
  for (const TimelineProcess& process : processes) {
    row("process_name", ",\"pid\":" + std::to_string(process.id), process.name);
    out << (&process != &processes.back() ? ",\n" : "\n");
  }
}

// The task's state after an event, until its `next` one or, without one, the end of the run.
std::string state_after(const Timeline& timeline, const TimelineEvent& event, const TimelineEvent* next) {
  if (event.operation == kernel::Operation::end) return "";
  if (event.waits_for >= 0) return "waiting for " + timeline.object(event.waits_for);
  if (next == nullptr || next->time == event.time) return "";  // ready, or the run ended
  return next->operation == kernel::Operation::sleep ? "sleeping" : "computing";
}

}  // namespace

std::string to_text(const Timeline& timeline, std::size_t lines_max) {
  std::size_t width = 0;
  for (const TimelineTask& task : timeline.tasks) width = std::max(width, task.title.size());
  std::vector<std::string> lines;
  for (const TimelineEvent& event : timeline.events) lines.push_back(line_of(timeline, event, width));
  lines = with_repeats_told(std::move(lines));
  const std::size_t from = lines.size() - std::min(lines.size(), lines_max);
  std::string text = from > 0 ? "  ... " + std::to_string(from) + " earlier lines\n" : "";
  for (std::size_t i = from; i < lines.size(); ++i) text += lines[i] + "\n";
  return text;
}

void write_trace(std::ostream& out, const Timeline& timeline) {
  const std::vector<TimelineEvent>& events = timeline.events;
  std::vector<std::int64_t> stamps_ns;
  std::int64_t end_ns = 0;
  for (const TimelineEvent& event : events) {
    stamps_ns.push_back(std::max(end_ns, event.time.ns()));
    end_ns = stamps_ns.back() + 1;
  }
  std::vector<std::size_t> next(events.size(), events.size());  // of the same task
  std::vector<std::size_t> following(timeline.tasks.size(), events.size());
  for (std::size_t i = events.size(); i-- > 0;) {
    next[i] = following[events[i].task];
    following[events[i].task] = i;
  }
  out << "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n";
  for (std::size_t i = 0; i < events.size(); ++i) {
    const TimelineEvent& event = events[i];
    const std::string where = place_of(timeline, event.task);
    const auto slice = [&](const std::string& title, const char* kind, std::int64_t from_ns, std::int64_t to_ns) {
      out << "{\"ph\":\"X\",\"name\":" << json_text(title) << ",\"cat\":\"" << kind
          << "\",\"ts\":" << microseconds(from_ns) << ",\"dur\":" << microseconds(to_ns - from_ns) << where << "},\n";
    };
    slice(timeline.words(event), event.is_switch ? "switch" : "event", stamps_ns[i], stamps_ns[i] + 1);
    const bool is_last = next[i] == events.size();
    const std::int64_t until_ns = is_last ? end_ns : stamps_ns[next[i]];
    const std::string state = state_after(timeline, event, is_last ? nullptr : &events[next[i]]);
    if (!state.empty() && until_ns > stamps_ns[i] + 1) slice(state, "state", stamps_ns[i] + 1, until_ns);
    if (event.woken_by < 0) continue;
    const auto from = static_cast<std::size_t>(event.woken_by);
    out << "{\"ph\":\"s\",\"name\":\"wakes\",\"cat\":\"wake\",\"id\":" << i
        << ",\"ts\":" << microseconds(stamps_ns[from]) << place_of(timeline, events[from].task) << "},\n";
    out << "{\"ph\":\"f\",\"bp\":\"e\",\"name\":\"wakes\",\"cat\":\"wake\",\"id\":" << i
        << ",\"ts\":" << microseconds(stamps_ns[i]) << where << "},\n";
  }
  name_rows(out, timeline);
  out << "]}\n";
}

}  // namespace waitpoint::exploration
