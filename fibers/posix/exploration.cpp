// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exploration.hpp"

#include "fibers/explore/strategies/continuation.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::posix {
namespace {

using exploration::Draws;

// Uses of primitives move virtual time on before a program without progress comes so far.
constexpr std::uint32_t steps_of_an_instant_max = 100'000'000;

exploration::Profile profile_of(const Asked& asked) {
  exploration::Profile profile;
  profile.steps = asked.steps;
  for (const Asked::TaskProfile& task : asked.tasks)
    profile.tasks.push_back({task.task, task.parent, task.events, {task.objects.begin(), task.objects.end()}});
  profile.shared.assign(asked.shared.begin(), asked.shared.end());
  return profile;
}

}  // namespace

Explored::Explored(kernel::Scheduler& scheduler, const Asked& asked)
    : explorer(scheduler, steps_of_an_instant_max), narrator(scheduler, explorer), known(profile_of(asked)) {
  begin(asked);
  watch(scheduler, asked);
}

void Explored::begin(const Asked& asked) {
  const char* stream = asked.strategy;
  if (asked.strategy[0] != '\0') {
    strategy = exploration::make_strategy(asked.strategy);
  } else if (asked.at_random_from != Asked::none) {
    strategy = std::make_unique<exploration::Continuation>(explorer, asked.at_random_from);
    stream = "continuation";
  } else {
    strategy = std::make_unique<exploration::Fifo>();
  }
  strategy->begin(asked.number, Draws(asked.seed, stream, asked.number), known);
  explorer.begin(*strategy, {.switches = asked.switches, .deviations = asked.deviations});
}

void Explored::watch(kernel::Scheduler& scheduler, const Asked& asked) {
  if (asked.decision != Asked::none) narrator.ask_for(asked.decision);
  if (asked.words || asked.decision != Asked::none)
    scheduler.set_decisions(narrator);
  else
    scheduler.set_decisions(explorer);
  if (asked.profile)
    scheduler.set_watch(&profiling_.emplace(profile));
  else if (asked.events)
    scheduler.set_watch(&recorder_.emplace(timeline, &explorer, asked.events_from));
}

}  // namespace waitpoint::posix
