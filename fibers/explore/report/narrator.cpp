// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/narrator.hpp"

#include <algorithm>
#include <cstdio>

#include "core/number_text.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/sync/report/object_names.hpp"

namespace waitpoint::exploration {
namespace {

std::string in_brackets(const Task& task) { return title_of(task) + " (" + next_event(task) + ")"; }

std::string milliseconds(Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%g ms", static_cast<double>(duration.ns()) * 1e-6);
  return text;
}

}  // namespace

void Narration::add(const Told& told, bool is_switch, bool is_answer) {
  if (is_answer) answer = told;
  if (is_switch) switches.push_back(told);
}

// Called after the explorer, whose last decision is then the current one.
template <class Words>
void Narrator::tell(std::size_t decisions_before, const Words& words) {
  if (decisions() == decisions_before) return;  // there was no choice
  const Decision& decision = explorer_.schedule().decisions.back();
  const bool is_answer = asked_ && *asked_ + 1 == decisions();
  if (!is_answer && !decision.is_switch()) return;
  const ChoiceText text = words(decision);
  keep({kernel::global_time(scheduler_), kernel::events(scheduler_), text.words, text.place}, decision.is_switch(),
       is_answer);
}

std::uint32_t Narrator::next(Task* const* ready, std::uint32_t count) {
  const std::size_t before = decisions();
  const std::uint32_t chosen = explorer_.next(ready, count);
  if (count > 1 && chosen < count)
    tell(before, [&](const Decision& decision) -> ChoiceText {
      const std::string one = in_brackets(*ready[decision.chosen]);
      if (decision.is_switch()) return {one + " goes first instead of " + in_brackets(*ready[decision.usual])};
      return {one + " goes first, the default of " + counted(count, "task")};
    });
  return chosen;
}

std::uint32_t Narrator::among(Choice choice, const Task& task, std::uint32_t count) {
  const std::size_t before = decisions();
  if (is_asked() && instead_) narration_.instead = in_words(choice, task, *instead_, count);
  const std::uint32_t chosen = explorer_.among(choice, task, count);
  tell(before, [&](const Decision& decision) {
    ChoiceText text = in_words(choice, task, decision.chosen, count);
    text.words = in_brackets(task) + " " + text.words;
    return text;
  });
  return chosen;
}

Duration Narrator::computing(const Task& task, Duration least, Duration greatest) {
  const std::size_t before = decisions();
  if (is_asked() && instead_)
    narration_.instead = ChoiceText{"computes " + milliseconds(Explorer::cost(least, greatest, *instead_))};
  const Duration chosen = explorer_.computing(task, least, greatest);
  tell(before, [&](const Decision& decision) -> ChoiceText {
    return {title_of(task) + " computes " + milliseconds(chosen) +
            (decision.is_switch() ? " instead of " + milliseconds(greatest) : ", the default")};
  });
  return chosen;
}

std::uint32_t Narrator::process(const Task& task, std::span<const char* const> names, std::uint32_t spinning,
                                bool can_continue) {
  const std::size_t before = decisions();
  const auto count = static_cast<std::uint32_t>(names.size());
  const std::uint32_t chosen = explorer_.process(task, count, spinning, can_continue);
  tell(before, [&](const Decision& decision) -> ChoiceText {
    const std::string one = std::string("process ") + names[decision.chosen];
    if (decision.is_switch()) return {one + " goes first instead of process " + names[decision.usual]};
    return {one + " goes first, the default of " + std::to_string(names.size()) + " processes"};
  });
  return chosen;
}

std::string to_text(const std::vector<Told>& switches, std::size_t lines_max) {
  const std::size_t from = switches.size() - std::min(switches.size(), lines_max);
  std::string text = from > 0 ? "  ... " + std::to_string(from) + " earlier\n" : "";
  for (std::size_t i = from; i < switches.size(); ++i)
    text += "  " + to_string(switches[i].time) + " s  " + switches[i].words + "\n";
  return text;
}

}  // namespace waitpoint::exploration
