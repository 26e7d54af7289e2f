// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/explain.hpp"

#include <optional>

#include "fibers/explore/body_watch.hpp"
#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/event_columns.hpp"
#include "fibers/explore/report/place_text.hpp"
#include "fibers/explore/schedules/event_stop.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/sync/report/object_names.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::size_t others_shown = 4;
constexpr std::size_t events_shown = 40;

// Ranks the passing alternatives of one decision by how well they explain the failure: best is the one that passes by
// reversing the two events between which is chosen, then one of them.
bool explains_better(const CriticalChoice& a, const CriticalChoice& b) {
  if (!a.reversed || !b.reversed) return a.reversed && !b.reversed;
  return a.reversed->indirection < b.reversed->indirection;
}

// Searches backwards from the end: a different choice, followed by the default order, that passes.
std::optional<CriticalChoice> find_last_critical_choice(Body& body, const Failure& failure, Effort effort) {
  const std::vector<Decision>& decisions = failure.schedule.decisions;
  Fifo rest;
  std::optional<CriticalChoice> best;
  for (std::size_t i = decisions.size(); i-- > 0 && !best;) {
    std::vector<Decision> changed(decisions.begin(), decisions.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    // The absence of a spurious wake-up explains nothing.
    if (decisions[i].choice == Choice::spurious && !decisions[i].is_switch()) continue;
    for (std::uint32_t other = 0; other < decisions[i].count; ++other) {
      if (other == decisions[i].chosen) continue;
      if (!effort.is_left()) return best;
      changed.back().chosen = other;
      const bool passed = body.run(rest, {.prefix = changed}).passed();
      effort.spend(body);
      if (!passed) continue;
      CriticalChoice crossing{i, other, body.explorer().schedule().decisions, {}};
      crossing.reversed = pair_in_other_order(take_events(body, decisions, i), take_events(body, crossing.passing, i));
      if (!best || explains_better(crossing, *best)) best = std::move(crossing);
    }
  }
  return best;
}

// An event as text, with its task's call stack.
struct ToldEvent {
  std::string words;
  sync::ReturnAddresses stack;
};

ToldEvent tell_event(Body& body, std::span<const Decision> decisions, const EventOf& event) {
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  EventStop stop(scheduler, body.explorer(), event);
  ToldEvent told;
  scheduler.set_decisions(stop);
  body.run_up_to({.prefix = decisions}, [&] {
    Task* const task = stop.stopped_before();
    if (task == nullptr) return;
    told.words = about_to(*task);
    told.stack.resize(frames_searched);
    told.stack.resize(kernel::call_stack(*task, told.stack.data(), told.stack.size()));
  });
  scheduler.set_decisions(body.explorer());
  return told;
}

// The two events in reversed order, or a statement that there are none.
std::string describe_pair(Body& body, const Failure& failure, const CriticalChoice& crossing) {
  if (!crossing.reversed) return "\n" + no_pair_in_words();
  const ToldEvent pair[] = {tell_event(body, failure.schedule.decisions, crossing.reversed->failing),
                            tell_event(body, crossing.passing, crossing.reversed->passing)};
  const sync::ReturnAddresses stacks[] = {pair[0].stack, pair[1].stack};
  const auto calls = sync::user_source_lines(stacks, frames_shown);
  return "\n" + pair_in_words(with_calls(pair[0].words, calls[0]), with_calls(pair[1].words, calls[1]));
}

const char* description(Choice choice) {
  switch (choice) {
    case Choice::task: return "the next task";
    case Choice::waiter: return "the waiter to wake";
    case Choice::spurious: return "a spurious wake-up";
    case Choice::loss: return "the loss of a datagram";
    case Choice::computing: return "the cost of a computation";
    case Choice::process: return "the next process";
    case Choice::value: return "the value that a load returns";
  }
  return "";
}

// The choice in words, without the pair.
std::string describe_choice(Body& body, const Failure& failure, const CriticalChoice& crossing) {
  const Decision& decision = failure.schedule.decisions[crossing.decision];
  std::string text = "number " + std::to_string(crossing.decision) + ", " + description(decision.choice);
  if (decision.choice != Choice::task) {
    ChoiceWords words(body.explorer(), crossing.decision, crossing.instead);
    body.run_watched_by(words, failure.schedule);
    if (words.chosen().words.empty()) return text;
    const std::vector<std::string> told = with_lines({words.chosen(), words.instead()});
    return text + ", " + told[0] + "; it passes if it " + told[1];
  }
  Played played{.prefix = failure.schedule.decisions};
  played.stop_at = crossing.decision;
  body.run_up_to(played, [&] {
    const std::span<Task* const> ready = body.explorer().stopped_before();
    if (ready.empty()) return;
    text += ", at " + to_string(body.simulation().global_time()) + " s";
    if (crossing.reversed && crossing.reversed->indirection == 0) return;  // these are the pair
    text += "\n  it fails with " + about_to(*ready[decision.chosen]) + ", and passes with " +
            about_to(*ready[crossing.instead]);
  });
  return text;
}

// Spurious wake-ups, waiters out of order, costs: switches that the order of tasks does not show.
std::string describe_other_switches(Body& body, const Schedule& schedule) {
  std::string text;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < schedule.decisions.size() && shown < others_shown; ++i) {
    const Decision& decision = schedule.decisions[i];
    if (decision.choice == Choice::task || !decision.is_switch()) continue;
    ChoiceWords words(body.explorer(), i, decision.usual);
    body.run_watched_by(words, schedule);
    text += "  " + with_lines({words.chosen()}).front() + "\n";
    ++shown;
  }
  return text;
}

}  // namespace

Failure with_places(Body& body, const Failure& failure) {
  Fifo rest;
  Failure placed = failure;
  body.tell(sync::Places::told);
  if (Outcome told = body.run(rest, {.prefix = failure.schedule.decisions}); !told.passed())
    placed.outcome = std::move(told);
  body.tell(sync::Places::left_out);
  return placed;
}

Explanation explain(Body& body, const Failure& failure, Effort effort) {
  const std::size_t switches = failure.schedule.switches.size();
  Explanation told;
  std::string& text = told.text;
  text = switches == 0   ? "the default order fails\n"
         : switches == 1 ? "one switch away from the default order fails\n"
                         : std::to_string(switches) + " switches away from the default order fail\n";
  text += describe_other_switches(body, failure.schedule);
  told.choice = find_last_critical_choice(body, failure, effort);
  if (told.choice) {
    told.choice_words = describe_choice(body, failure, *told.choice);
    text += "the last choice from which it could still have passed" +
            std::string(switches == 0 ? " by deviating from the default order" : "") + ": " + told.choice_words +
            describe_pair(body, failure, *told.choice);
  }
  told.steps = to_text(take_timeline(body, failure.schedule.decisions), events_shown);
  text += "events of the tasks (*: switch away from the default order):\n" + told.steps;
  return told;
}

void add_schedules(Body& body, const Failure& failure, const std::optional<CriticalChoice>& choice,
                   FindingFile& finding) {
  std::vector<EventOf> pair;
  if (choice && choice->reversed) pair = {choice->reversed->failing, choice->reversed->passing};
  const auto told = [&](std::span<const Decision> decisions) {
    const Timeline timeline = take_timeline(body, decisions);
    FindingSchedule schedule{to_columns(timeline, pair)};
    for (std::size_t i = 0; i < pair.size(); ++i) {
      const ToldEvent event = tell_event(body, decisions, pair[i]);
      if (event.words.empty()) continue;
      const sync::ReturnAddresses stacks[] = {event.stack};
      schedule.pair[i] = {event.words, sync::user_source_lines(stacks, frames_shown).front()};
    }
    return schedule;
  };
  finding.fails = told(failure.schedule.decisions);
  if (choice) finding.passes = told(choice->passing);
  if (pair.empty())
    finding.note = choice ? no_pair_in_words() : "no run with another choice is known that passes: it fails by itself";
}

}  // namespace waitpoint::exploration
