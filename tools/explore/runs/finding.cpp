// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/finding.hpp"

#include <fmt/format.h>

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

template <class Pass, class Lesson>
void pass_lesson(Pass& pass, Lesson& lesson) {
  pass(lesson.choices);
  pass(lesson.pairs);
  pass(lesson.progress);
  pass(lesson.profile.steps);
  pass(lesson.profile.shared);
  pass(lesson.profile.code);
}

template <class Pass, class Evidence>
void pass_evidence(Pass& pass, Evidence& evidence) {
  for (auto* const text :
       {&evidence.details, &evidence.told, &evidence.system_calls, &evidence.last_events, &evidence.cause,
        &evidence.trace, &evidence.columns, &evidence.scene, &evidence.frames, &evidence.trail})
    pass(*text);
  pass(evidence.log);
}

// The order of the fields, for both directions.
template <class Pass, class Verdict, class F>
void pass_fields(Pass& pass, Verdict& verdict, F& finding) {
  pass(verdict);
  pass(finding.words);
  pass(finding.racing);
  pass(finding.switches);
  pass(finding.deviations);
  pass_lesson(pass, finding.lesson);
  pass_evidence(pass, finding.evidence);
}

}  // namespace

std::string to_bytes(const Finding& finding) {
  FieldWriter writer;
  pass_fields(writer, static_cast<const exploration::RunVerdict&>(finding), finding);
  writer(finding.lesson.profile.tasks.size());
  for (const auto& task : finding.lesson.profile.tasks) pass_task(writer, task);
  writer(finding.evidence.races.size());
  for (const auto& race : finding.evidence.races) pass_race(writer, race);
  return std::move(writer.bytes);
}

Finding finding_of(std::string_view bytes) {
  Finding finding;
  FieldReader reader(bytes);
  pass_fields(reader, static_cast<exploration::RunVerdict&>(finding), finding);
  std::size_t tasks = 0, races = 0;
  reader(tasks);
  finding.lesson.profile.tasks.resize(tasks);
  for (auto& task : finding.lesson.profile.tasks) pass_task(reader, task);
  reader(races);
  finding.evidence.races.resize(races);
  for (auto& race : finding.evidence.races) pass_race(reader, race);
  return finding;
}

std::string digest_text(std::uint64_t digest) { return fmt::format("wp1:{:016x}", digest); }

}  // namespace waitpoint::tools
