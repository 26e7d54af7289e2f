// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/exploration.hpp"

#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/schedules/course.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/posix/base/symbols.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reports/program_calls.hpp"
#include "fibers/sync/report/object_names.hpp"

namespace waitpoint::posix {
namespace {

// Never reached: uses of primitives advance virtual time before.
constexpr std::uint32_t steps_of_an_instant_max = 100'000'000;

exploration::Profile profile_of(const Asked& asked) {
  exploration::Profile profile;
  profile.steps = asked.steps;
  profile.memory = asked.memory;
  for (const Asked::TaskProfile& task : asked.tasks)
    profile.tasks.push_back({task.task, task.parent, task.events, {task.objects.begin(), task.objects.end()}});
  profile.shared.assign(asked.shared.begin(), asked.shared.end());
  return profile;
}

}  // namespace

namespace {

template <class T>
std::span<const T> shared_copy(std::span<const T> values) {
  if (values.empty()) return {};
  T* const copy = static_cast<T*>(family::take(values.size_bytes()));
  if (copy == nullptr) refuse("there is no memory for the request of this run");
  std::copy(values.begin(), values.end(), copy);
  return {copy, values.size()};
}

}  // namespace

const Asked* shared_copy(const Asked& asked) {
  Asked& copy = *new (family::take(sizeof(Asked))) Asked();
  std::memcpy(copy.strategy, asked.strategy, sizeof copy.strategy);
  copy.seed = asked.seed;
  copy.number = asked.number;
  copy.switches = shared_copy(asked.switches);
  copy.deviations = shared_copy(asked.deviations);
  copy.at_random_from = asked.at_random_from;
  copy.steps = asked.steps;
  copy.memory = asked.memory;
  copy.words = asked.words;
  copy.events = asked.events;
  copy.events_from = asked.events_from;
  copy.decision = asked.decision;
  return &copy;
}

Explored::Explored(kernel::Scheduler& scheduler, const Asked& asked)
    : explorer(scheduler, steps_of_an_instant_max, asked.memory),
      narrator(scheduler, explorer),
      known(profile_of(asked)) {
  begin(asked);
  watch(scheduler, asked);
}

exploration::Course Explored::course_of(const Asked& asked) const {
  const auto id = static_cast<std::uint64_t>(family::own->id);
  const std::uint64_t number = family::is_first() ? asked.number : Digest::mix(asked.number ^ Digest::mix(id));
  exploration::Course course{asked.strategy, asked.seed, number};
  if (family::is_first()) {
    course.constraints = asked.constraints;
    course.progress = asked.progress;
  }
  if (asked.at_random_from != Asked::none) course.at_random_from = asked.at_random_from;
  return course;
}

void Explored::begin_course(const Asked& asked) {
  strategy = exploration::begin_course(course_of(asked), explorer, known);
  WAITPOINT_CHECK(strategy != nullptr, "a course of exploration has no strategy");
}

void Explored::continue_in_process(const Asked& asked) {
  begin_course(asked);
  explorer.record(nullptr);
  explorer.decide_by(*strategy);
}

void Explored::begin_again(const Asked& asked) {
  begin_course(asked);
  explorer.play(*strategy, {.switches = asked.switches, .deviations = asked.deviations});
}

void Explored::begin(const Asked& asked) {
  begin_course(asked);
  if (asked.pairs) explorer.record(&relation);
  explorer.begin(*strategy, {.switches = asked.switches, .deviations = asked.deviations});
}

void Explored::watch(kernel::Scheduler& scheduler, const Asked& asked) {
  sync::name_variables_by(symbol_at);
  if (asked.decision != Asked::none) narrator.ask_for(asked.decision);
  const auto begin_in_process = [] { record->explored->continue_in_process(*record->settings.asked); };
  if (asked.stops)
    processes.emplace(scheduler, explorer, stop_.emplace(scheduler, explorer, asked.stop_before), begin_in_process);
  else if (asked.words || asked.decision != Asked::none)
    processes.emplace(scheduler, explorer, narrator, begin_in_process, &narrator);
  else
    processes.emplace(scheduler, explorer, explorer, begin_in_process);
  kernel::set_decisions(scheduler, *processes);
  if (asked.profile)
    kernel::set_watch(scheduler, &profiling_.emplace(profile));
  else if (asked.events)
    kernel::set_watch(scheduler, &recorder.emplace(&explorer, asked.events_from));
  else if (asked.log_from != Asked::none)
    kernel::set_watch(scheduler, &log_.emplace(log, explorer, asked.log_from));
}

void Explored::note_stop() {
  kernel::Task* const task = stop_ ? stop_->stopped_before() : nullptr;
  if (task == nullptr) return;
  stopped_before = exploration::about_to(*task);
  stopped_calls = program_calls(*task);
}

}  // namespace waitpoint::posix
