// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/event_columns.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "fibers/explore/report/json_text.hpp"

namespace waitpoint::exploration {
namespace {

struct Part {
  std::size_t begin, end;
};

template <class Write>
std::string list(std::size_t begin, std::size_t end, const Write& write) {
  std::string text = "[";
  for (std::size_t i = begin; i < end; ++i) text += (i > begin ? "," : "") + write(i);
  return text + "]";
}

std::string title_of_process(const Timeline& timeline, std::uint32_t index) {
  const TimelineProcess& process = timeline.processes[index];
  const auto is_namesake = [&](const TimelineProcess& other) { return other.name == process.name; };
  const bool is_alone = std::ranges::count_if(timeline.processes, is_namesake) == 1;
  return is_alone ? process.name : process.name + " " + std::to_string(process.id);
}

std::string task_text(const Timeline& timeline, const TimelineTask& task) {
  const std::string owner = timeline.processes.empty() ? task.robot : title_of_process(timeline, task.process);
  return "[" + std::to_string(task.number) + "," + json_text(task.name) + "," + json_text(owner) + "]";
}

std::string object_text(const TimelineObject& object) {
  return "[" + json_text(object.kind) + "," + std::to_string(object.number) + "," + json_text(object.label) + "," +
         json_text(object.robot) + "]";
}

// A process that was forked has the tasks of its parent: the event is the first process's.
std::optional<std::size_t> place_of(const Timeline& timeline, const EventOf& event) {
  const auto found = std::ranges::find_if(timeline.events, [&](const TimelineEvent& other) {
    return other.which == event && timeline.tasks[other.task].process == 0;
  });
  if (found == timeline.events.end()) return std::nullopt;
  return static_cast<std::size_t>(found - timeline.events.begin());
}

Part part_shown(const Timeline& timeline, const std::vector<std::optional<std::size_t>>& places, std::size_t most) {
  const std::size_t all = timeline.events.size();
  if (all <= most) return {0, all};
  std::size_t begin = all - most;
  for (const auto& place : places)
    if (place) begin = std::min(begin, *place - std::min(*place, most / 4));
  return {begin, begin + most};
}

// What each task waits for after its last event there, as pairs of indices.
std::string waits(const Timeline& timeline, const Part& part) {
  std::vector<std::int32_t> waits_for(timeline.tasks.size(), -1);
  for (std::size_t i = part.begin; i < part.end; ++i) waits_for[timeline.events[i].task] = timeline.events[i].waits_for;
  std::string text;
  for (std::size_t task = 0; task < waits_for.size(); ++task)
    if (waits_for[task] >= 0)
      text += (text.empty() ? "[" : ",[") + std::to_string(task) + "," + std::to_string(waits_for[task]) + "]";
  return "[" + text + "]";
}

std::string switches(const Timeline& timeline, const Part& part) {
  std::string text;
  for (std::size_t i = part.begin; i < part.end; ++i)
    if (timeline.events[i].is_switch) text += (text.empty() ? "" : ",") + std::to_string(i - part.begin);
  return "[" + text + "]";
}

}  // namespace

std::string to_columns(const Timeline& timeline, std::span<const EventOf> marked, std::size_t events_max) {
  const std::vector<TimelineEvent>& events = timeline.events;
  std::vector<std::optional<std::size_t>> places;
  for (const EventOf& event : marked) places.push_back(place_of(timeline, event));
  const Part part = part_shown(timeline, places, events_max);
  std::vector<std::int64_t> stamps_ns;
  stamps_ns.reserve(part.end - part.begin);
  for (std::size_t i = part.begin; i < part.end; ++i)
    stamps_ns.push_back(std::max(events[i].time.ns(), stamps_ns.empty() ? 0 : stamps_ns.back() + 1));
  const std::uint64_t before = timeline.events_before + part.begin;
  const std::int64_t from = stamps_ns.empty() || before == 0 ? 0 : stamps_ns.front();
  const auto column = [&](const auto& value) {
    return list(part.begin, part.end, [&](std::size_t i) { return std::to_string(value(i, i - part.begin)); });
  };
  const auto step = [&](std::size_t, std::size_t i) { return stamps_ns[i] - (i == 0 ? from : stamps_ns[i - 1]); };
  const auto shift = [&](std::size_t at, std::size_t i) { return stamps_ns[i] - events[at].time.ns(); };
  std::string text = "{\"kind\":\"events\",\"from\":" + std::to_string(from) +
                     ",\"to\":" + std::to_string(stamps_ns.empty() ? from : stamps_ns.back() + 1) +
                     ",\"complete\":" + (part.end == events.size() ? "true" : "false") +
                     ",\"first\":" + std::to_string(before + 1);
  text += ",\"tasks\":" +
          list(0, timeline.tasks.size(), [&](std::size_t i) { return task_text(timeline, timeline.tasks[i]); });
  text += ",\"objects\":" +
          list(0, timeline.objects.size(), [&](std::size_t i) { return object_text(timeline.objects[i]); });
  text += ",\"t\":" + column(step) + ",\"s\":" + column(shift);
  text += ",\"k\":" + column([&](std::size_t at, std::size_t) { return events[at].task; });
  text += ",\"o\":" + column([&](std::size_t at, std::size_t) { return static_cast<int>(events[at].operation); });
  text += ",\"x\":" + column([&](std::size_t at, std::size_t) { return events[at].object; });
  text += ",\"switches\":" + switches(timeline, part) + ",\"waits\":" + waits(timeline, part);
  const auto number = [&](std::size_t i) {
    return places[i] ? std::to_string(timeline.events_before + *places[i] + 1) : std::string("null");
  };
  return text + ",\"marked\":" + list(0, places.size(), number) + "}";
}

}  // namespace waitpoint::exploration
