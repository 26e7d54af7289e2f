// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/exploration.hpp"

#include <dlfcn.h>

#include "core/error.hpp"
#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/schedules/course.hpp"
#include "fibers/kernel/visit.hpp"

namespace waitpoint::posix {
namespace {

// Never reached: uses of primitives advance virtual time before.
constexpr std::uint32_t steps_of_an_instant_max = 100'000'000;

exploration::Profile profile_of(const Asked& asked) {
  exploration::Profile profile;
  profile.steps = asked.steps;
  for (const Asked::TaskProfile& task : asked.tasks)
    profile.tasks.push_back({task.task, task.parent, task.events, {task.objects.begin(), task.objects.end()}});
  profile.shared.assign(asked.shared.begin(), asked.shared.end());
  return profile;
}

// The layer's own module: its frames are left out of call stacks.
std::string own_module() {
  Dl_info own{};
  return dladdr(reinterpret_cast<void*>(&profile_of), &own) != 0 ? own.dli_fname : "";
}

}  // namespace

Explored::Explored(kernel::Scheduler& scheduler, const Asked& asked)
    : explorer(scheduler, steps_of_an_instant_max), narrator(scheduler, explorer), known(profile_of(asked)) {
  begin(asked);
  watch(scheduler, asked);
}

void Explored::begin(const Asked& asked) {
  exploration::Course course{asked.strategy, asked.seed, asked.number, {}};
  if (asked.at_random_from != Asked::none) course.at_random_from = asked.at_random_from;
  strategy = exploration::begin_course(course, explorer, known);
  WAITPOINT_CHECK(strategy != nullptr, "a course of exploration has no strategy");
  explorer.begin(*strategy, {.switches = asked.switches, .deviations = asked.deviations});
}

void Explored::watch(kernel::Scheduler& scheduler, const Asked& asked) {
  if (asked.decision != Asked::none) narrator.ask_for(asked.decision);
  if (asked.stops)
    scheduler.set_decisions(stop_.emplace(scheduler, explorer, asked.stop_before));
  else if (asked.words || asked.decision != Asked::none)
    scheduler.set_decisions(narrator);
  else
    scheduler.set_decisions(explorer);
  if (asked.profile)
    scheduler.set_watch(&profiling_.emplace(profile));
  else if (asked.events)
    scheduler.set_watch(&recorder_.emplace(timeline, &explorer, asked.events_from));
  else if (asked.log_from != Asked::none)
    scheduler.set_watch(&log_.emplace(log, explorer, asked.log_from));
}

void Explored::note_stop() {
  kernel::Task* const task = stop_ ? stop_->stopped_before() : nullptr;
  if (task == nullptr) return;
  stopped_before = exploration::about_to(*task);
  void* frames[exploration::frames_searched];
  const std::size_t count = kernel::call_stack(*task, frames, exploration::frames_searched);
  WAITPOINT_CHECK(count <= exploration::frames_searched, "a call stack is longer than its room");
  const std::string own = own_module();
  for (std::size_t i = 0; i < count; ++i)
    if (sync::CodePlace place = sync::code_place_of(frames[i]); place.module != own)
      stopped_calls.push_back(std::move(place));
}

}  // namespace waitpoint::posix
