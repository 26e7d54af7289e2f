// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/analysis/finding_schedules.hpp"

#include <algorithm>
#include <utility>

#include "fibers/explore/report/event_columns.hpp"

namespace waitpoint::exploration {
namespace {

// What a long run shows before the pair, or, without one, before the failure; what a run shows after it.
constexpr Duration lead = std::chrono::seconds(1), last_seconds = std::chrono::seconds(2),
                   survival_shown = std::chrono::milliseconds(500);

// The lines of with_calls() in their parts.
FindingEvent event_told(const std::string& told) {
  constexpr std::string_view call = "      at ";
  FindingEvent event;
  for (std::size_t begin = 0; begin < told.size();) {
    const std::size_t end = std::min(told.find('\n', begin), told.size());
    const std::string line = told.substr(begin, end - begin);
    if (line.starts_with(call))
      event.calls.push_back(line.substr(call.size()));
    else
      event.words += (event.words.empty() ? "" : "\n") + line;
    begin = end + 1;
  }
  return event;
}

class Schedules {
 public:
  Schedules(Target& target, const Finding& failure, const ReversedEvents& reversed)
      : target_(target), events_{.page = true} {
    if (reversed.pair) {
      events_.marked = {reversed.pair->failing.event, reversed.pair->passing.event};
      events_.marked_count = 2;
    }
    const Time from = reversed.pair ? reversed.from - lead : failure.end - last_seconds;
    if (failure.events > page_events_max) events_.from = std::max(Time(), from);
  }

  /// Of the run by this plan; its floor is `scene`.
  FindingSchedule told(const Plan& plan, std::string& scene) {
    FindingSchedule schedule;
    if (std::optional<Finding> run = target_.repeat(plan, {.events = events_})) {
      schedule.events = std::move(run->evidence.columns);
      schedule.frames = std::move(run->evidence.frames);
      scene = std::move(run->evidence.scene);
    }
    if (schedule.events.empty()) schedule.events = to_columns({}, {});
    for (std::size_t i = 0; i < events_.marked_count; ++i) schedule.pair[i] = event(plan, events_.marked[i]);
    return schedule;
  }

 private:
  std::optional<FindingEvent> event(const Plan& plan, const EventOf& which) {
    const std::optional<Finding> stopped = target_.repeat(plan, {.stop_before = which});
    if (!stopped || stopped->evidence.told.empty()) return std::nullopt;
    return event_told(stopped->evidence.told);
  }

  Target& target_;
  WantedEvents events_;
};

}  // namespace

void add_schedules(Target& target, const Plan& failing, const Finding& failure, const ReversedEvents& reversed,
                   FindingFile& finding) {
  Schedules schedules(target, failure, reversed);
  finding.fails = schedules.told(failing, finding.scene);
  if (!reversed.passing) return;
  Plan passing = *reversed.passing;
  if (!target.traits().is_cheap) passing.until = std::min(passing.until, failure.end + survival_shown);
  std::string same_scene;
  finding.passes = schedules.told(passing, same_scene);
}

}  // namespace waitpoint::exploration
