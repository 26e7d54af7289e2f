// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "fibers/explore/report/event_columns.hpp"
#include "fibers/explore/report/place_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "tools/explore/runs/fields.hpp"

namespace waitpoint::tools {
namespace {

template <class Pass, class Task>
void pass_task(Pass& pass, Task& task) {
  pass(task.task);
  pass(task.parent);
  pass(task.events);
  pass(task.objects);
}

template <class Pass, class Race>
void pass_race(Pass& pass, Race& race) {
  pass(race.lines);
  pass(race.headline);
  pass(race.text);
}

// The order of the fields, for both directions.
template <class Pass, class F>
void pass_fields(Pass& pass, F& finding) {
  pass(finding.kind);
  pass(finding.words);
  pass(finding.digest);
  pass(finding.end);
  pass(finding.events);
  pass(finding.decisions);
  pass(finding.switches);
  pass(finding.deviations);
  pass(finding.choices);
  pass(finding.order);
  pass(finding.is_beyond_enumeration);
  pass(finding.pairs);
  pass(finding.progress);
  pass(finding.was_cut);
  pass(finding.cuts_polls_short);
  pass(finding.has_unlearned_code);
  pass(finding.has_left_out_values);
  pass(finding.switch_at);
  pass(finding.obstacle);
  pass(finding.parted);
  pass(finding.racing);
  pass(finding.details);
  pass(finding.told);
  pass(finding.system_calls);
  pass(finding.last_events);
  pass(finding.trace);
  pass(finding.columns);
  pass(finding.scene);
  pass(finding.frames);
  pass(finding.log);
  pass(finding.trail);
  pass(finding.profile.steps);
  pass(finding.profile.shared);
  pass(finding.profile.code);
}

constexpr std::size_t events_shown = 30, lines_of_switches_max = 12;

// Ignores numbers: those in the words differ from schedule to schedule.
std::string without_digits(std::string text) {
  std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  return text;
}

}  // namespace

void Finding::take(const exploration::Schedule& schedule, bool has_parted) {
  decisions = schedule.decisions.size();
  cuts_polls_short = schedule.cuts_polls_short;
  parted = has_parted;
  if (passed()) return;
  switches = schedule.switches;
  deviations = schedule.deviations();
}

void Finding::tell(const exploration::Narration& narration, bool decision_asked, bool switches_too) {
  if (const auto& answer = narration.answer; decision_asked && answer)
    told = "at " + to_string(answer->time) + " s: " + exploration::with_lines(std::vector{*answer}).front().words;
  else if (switches_too)
    told = to_text(exploration::with_lines(narration.switches), lines_of_switches_max);
}

void Finding::tell(const exploration::Timeline& timeline, const TimelineForms& forms) {
  last_events = to_text(timeline, events_shown);
  if (forms.columns) columns = to_columns(timeline, forms.marked);
  if (!forms.trace) return;
  std::ostringstream text;
  write_trace(text, timeline);
  trace = text.str();
}

void Finding::tell(const std::string& event, const std::vector<std::string>& calls) {
  told = exploration::with_calls("at " + to_string(end) + " s: " + event, calls);
}

bool is_same_failure(const Finding& a, const Finding& b) {
  if (a.passed() || a.kind != b.kind) return false;
  // The tasks of a deadlock, and the places of a lack of progress, may differ.
  if (a.kind == Finding::Kind::deadlock || a.kind == Finding::Kind::no_progress) return true;
  if (a.kind == Finding::Kind::race)
    return std::find_first_of(a.racing.begin(), a.racing.end(), b.racing.begin(), b.racing.end()) != a.racing.end();
  return without_digits(a.headline()) == without_digits(b.headline());
}

std::string to_bytes(const Finding& finding) {
  FieldWriter writer;
  pass_fields(writer, finding);
  writer(finding.profile.tasks.size());
  for (const auto& task : finding.profile.tasks) pass_task(writer, task);
  writer(finding.races.size());
  for (const auto& race : finding.races) pass_race(writer, race);
  return std::move(writer.bytes);
}

Finding finding_of(std::string_view bytes) {
  Finding finding;
  FieldReader reader(bytes);
  pass_fields(reader, finding);
  std::size_t tasks = 0, races = 0;
  reader(tasks);
  finding.profile.tasks.resize(tasks);
  for (auto& task : finding.profile.tasks) pass_task(reader, task);
  reader(races);
  finding.races.resize(races);
  for (auto& race : finding.races) pass_race(reader, race);
  return finding;
}

std::string digest_text(std::uint64_t digest) { return fmt::format("wp1:{:016x}", digest); }

}  // namespace waitpoint::tools
