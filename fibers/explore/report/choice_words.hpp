// SPDX-License-Identifier: BSD-3-Clause
// Tasks and what they choose, in words: who was woken, which wait ended for nothing, how long a computation took.
#pragma once

#include <string>

#include "fibers/explore/schedules/explorer.hpp"

namespace waitpoint::exploration {

/// "consumer#2 of r1": tasks of one name are told apart by their numbers. The robot is left out where there are none.
std::string title_of(const Task& task);
/// "consumer#2, about to lock mutex #1".
std::string about_to(const Task& task);

/// What `task` does by an alternative of `count`, other than one between tasks: "wakes thread#3", "goes on for
/// nothing".
std::string in_words(Choice choice, const Task& task, std::uint32_t alternative, std::uint32_t count);

/// Stands between the kernel and an explorer for one run, and says of one decision what was chosen, and what another
/// alternative would have been.
class ChoiceWords final : public kernel::Decisions {
 public:
  /// Of decision `number`, which is not one between tasks, against its alternative `instead`.
  ChoiceWords(Explorer& explorer, std::size_t number, std::uint32_t instead)
      : explorer_(explorer), number_(number), instead_(instead) {}

  /// "at 0.010000000 s: thread#1 (notify_one condition variable #2) wakes thread#3; it passes if it wakes thread#4".
  /// Empty as long as the run has not come to it.
  std::string text() const { return text_.empty() ? "" : text_ + "; it passes if it " + other_; }
  /// The same without the alternative.
  const std::string& chosen() const { return text_; }

  std::uint32_t next(Task* const* ready, std::uint32_t count) override { return explorer_.next(ready, count); }
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  Duration computing(const Task& task, Duration least, Duration greatest) override;

 private:
  bool is_it() const { return explorer_.schedule().decisions.size() == number_; }
  void say(const Task& task, const std::string& chosen, const std::string& instead);

  Explorer& explorer_;
  std::size_t number_;
  std::uint32_t instead_;
  std::string text_, other_;
};

}  // namespace waitpoint::exploration
