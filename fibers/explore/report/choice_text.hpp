// SPDX-License-Identifier: BSD-3-Clause
// Text for tasks and their choices: the woken waiter, a spurious wake-up, the cost of a computation.
#pragma once

#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/sync/report/code_place.hpp"

namespace waitpoint::exploration {

/// "consumer#2 of r1": the number distinguishes tasks of one name. Without robots, the robot is omitted.
std::string title_of(const Task& task);
/// "consumer#2, about to lock mutex #1".
std::string about_to(const Task& task);

/// An alternative in words, and the code that they name at their end; none without its module.
struct ChoiceText {
  std::string words;
  sync::CodePlace place = {};
};

/// The effect of an alternative other than one between tasks: "wakes thread#3", "wakes up spuriously". During the
/// choice.
ChoiceText in_words(Choice choice, const Task& task, std::uint32_t alternative, std::uint32_t count);

/// Sits between the kernel and an explorer for one run, and describes one decision: the choice, and the alternative to
/// it.
class ChoiceWords final : public kernel::Decisions {
 public:
  /// For decision `number`, which is not one between tasks, and its alternative `instead`.
  ChoiceWords(Explorer& explorer, std::size_t number, std::uint32_t instead)
      : explorer_(explorer), number_(number), instead_(instead) {}

  /// "at 0.010000000 s: thread#1 (notify_one condition variable #2) wakes thread#3". Empty until the run has reached
  /// the decision.
  const ChoiceText& chosen() const { return chosen_; }
  /// "wakes thread#4".
  const ChoiceText& instead() const { return other_; }

  std::uint32_t next(Task* const* ready, std::uint32_t count) override { return explorer_.next(ready, count); }
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  Duration computing(const Task& task, Duration least, Duration greatest) override;

 private:
  bool is_it() const { return explorer_.schedule().decisions.size() == number_; }
  void say(const Task& task, ChoiceText chosen, ChoiceText instead);

  Explorer& explorer_;
  std::size_t number_;
  std::uint32_t instead_;
  ChoiceText chosen_, other_;
};

}  // namespace waitpoint::exploration
