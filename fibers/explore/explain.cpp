// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/explain.hpp"

#include <optional>

#include "fibers/explore/body_watch.hpp"
#include "fibers/explore/choice_words.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/sync/object_names.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::size_t frames_searched = 24;
constexpr std::size_t frames_shown = 4;
constexpr std::size_t others_shown = 4;
constexpr std::size_t events_shown = 40;

struct Crossing {
  std::size_t decision;
  std::uint32_t instead;  // with which it passes
};

// From the end backwards: where another choice, and the default order from there on, passes.
std::optional<Crossing> last_crossing(Body& body, const Failure& failure, Effort effort) {
  const std::vector<Decision>& decisions = failure.schedule.decisions;
  Fifo rest;
  for (std::size_t i = decisions.size(); i-- > 0;) {
    std::vector<Decision> changed(decisions.begin(), decisions.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    // That a wait might have ended for nothing explains nothing.
    if (decisions[i].choice == Choice::spurious && !decisions[i].is_switch()) continue;
    for (std::uint32_t other = 0; other < decisions[i].count; ++other) {
      if (other == decisions[i].chosen) continue;
      if (!effort.is_left()) return std::nullopt;
      changed.back().chosen = other;
      const bool passed = body.run(rest, {.prefix = changed}).passed();
      effort.spend(body);
      if (passed) return Crossing{i, other};
    }
  }
  return std::nullopt;
}

// At a choice between tasks: the one that came, and the one that should have.
std::string describe_pair(Body& body, const Decision& decision, std::span<Task* const> ready, std::uint32_t instead) {
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  Task* const pair[] = {ready[decision.chosen], ready[instead]};
  std::vector<sync::ReturnAddresses> stacks;
  for (Task* task : pair) {
    sync::ReturnAddresses& stack = stacks.emplace_back(frames_searched);
    stack.resize(scheduler.call_stack(*task, stack.data(), stack.size()));
  }
  const auto places = sync::user_source_lines(stacks, frames_shown);
  const char* const words[] = {"\n  goes first here:             ", "\n  goes first where it passes:  "};
  std::string text;
  for (std::size_t i = 0; i < 2; ++i) {
    text += words[i] + about_to(*pair[i]);
    for (const std::string& line : places[i]) text += "\n      at " + line;
  }
  return text;
}

const char* description(Choice choice) {
  switch (choice) {
    case Choice::task: return "which task goes on";
    case Choice::waiter: return "who is woken";
    case Choice::spurious: return "whether a wait ends for nothing";
    case Choice::loss: return "whether a datagram is lost";
    case Choice::computing: return "how long a computation takes";
  }
  return "";
}

// In words; empty where there is none.
std::string describe_last_crossing(Body& body, const Failure& failure, Effort effort) {
  const std::optional<Crossing> crossing = last_crossing(body, failure, effort);
  if (!crossing) return "";
  const Decision& decision = failure.schedule.decisions[crossing->decision];
  std::string text = "the last choice from which it could still have passed: number " +
                     std::to_string(crossing->decision) + ", " + description(decision.choice);
  if (decision.choice != Choice::task) {
    ChoiceWords words(body.explorer(), crossing->decision, crossing->instead);
    body.run_watched_by(words, failure.schedule);
    return text + ", " + words.text();
  }
  Played played{.prefix = failure.schedule.decisions};
  played.stop_at = crossing->decision;
  body.run_up_to(played, [&] {
    const std::span<Task* const> ready = body.explorer().stopped_before();
    if (ready.empty()) return;
    text += ", at " + to_string(body.simulation().global_time()) + " s" +
            describe_pair(body, decision, ready, crossing->instead);
  });
  return text;
}

// Waits that end for nothing, waiters out of their order, costs: what no order of tasks shows.
std::string describe_other_switches(Body& body, const Schedule& schedule) {
  std::string text;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < schedule.decisions.size() && shown < others_shown; ++i) {
    const Decision& decision = schedule.decisions[i];
    if (decision.choice == Choice::task || !decision.is_switch()) continue;
    ChoiceWords words(body.explorer(), i, decision.usual);
    body.run_watched_by(words, schedule);
    text += "  " + words.chosen() + "\n";
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

std::string explain(Body& body, const Failure& failure, Effort effort) {
  const std::size_t switches = failure.schedule.switches.size();
  std::string text = switches == 0   ? "it is the default order that fails\n"
                     : switches == 1 ? "one switch away from the default order fails\n"
                                     : std::to_string(switches) + " switches away from the default order fail\n";
  text += describe_other_switches(body, failure.schedule);
  if (const std::string why = describe_last_crossing(body, failure, effort); !why.empty()) text += why + "\n";
  return text + "what the tasks did (*: in place of one that could have gone on):\n" +
         to_text(take_timeline(body, failure.schedule), events_shown);
}

}  // namespace waitpoint::exploration
